"""The machine's own job and its file."""

from __future__ import annotations

from .meaning import N_, Table

JOB: Table = (
    (
        "job",
        (
            ("build", "", N_("Objects of the print")),
            ("duration", "s", N_("Time since the job started")),
            ("file", "", N_("File of the job")),
            ("filePosition", "bytes", N_("How far the file was read")),
            ("firstLayerDuration", "s", N_("Time of the first layer")),
            ("lastDuration", "s", N_("Time of the last job")),
            ("lastFileName", "", N_("File of the last job")),
            ("lastWarmUpDuration", "s", N_("Warm-up time of the last job")),
            ("layer", "", N_("Layer now, the first is 1")),
            ("layerTime", "s", N_("Time in this layer")),
            ("pauseDuration", "s", N_("Time in pauses")),
            ("rawExtrusion", "mm", N_("Filament, without the extrusion factor")),
            ("warmUpDuration", "s", N_("Warm-up time")),
        ),
    ),
    (
        "job.build",
        (
            ("currentObject", "", N_("Object now, -1 for none")),
            ("m486Names", "", N_("Whether the file names its objects")),
            ("m486Numbers", "", N_("Whether the file numbers its objects")),
            ("objects", "", N_("Objects of the print")),
        ),
    ),
    (
        "job.build.objects[]",
        (
            ("cancelled", "", N_("Whether it was cancelled")),
            ("name", "", N_("Name of the object")),
            ("x y", "mm", N_("Lowest and highest position")),
        ),
    ),
    (
        "job.file",
        (
            ("customInfo", "", N_("What the slicer put in besides")),
            ("filament", "mm", N_("Filament of each extruder")),
            ("fileName", "", N_("Path of the file")),
            ("firstLayerHeight", "mm", N_("Height of the first layer")),
            ("generatedBy", "", N_("Slicer of the file")),
            ("height", "mm", N_("Height of the print")),
            ("lastModified", "", N_("Date of the file")),
            ("layerHeight", "mm", N_("Height of a layer")),
            ("numLayers", "", N_("Number of layers")),
            ("printTime", "s", N_("Print time by the slicer")),
            ("simulatedTime", "s", N_("Print time by simulation")),
            ("size", "bytes", N_("Size of the file")),
            ("thumbnails", "", N_("Pictures in the file")),
        ),
    ),
    (
        "job.file.thumbnails[]",
        (
            ("format", "", N_("Format of the picture")),
            ("height", "px", N_("Height of the picture")),
            ("offset", "bytes", N_("Where it is in the file")),
            ("size", "bytes", N_("Its length in the file")),
            ("width", "px", N_("Width of the picture")),
        ),
    ),
    (
        "job.timesLeft",
        (
            ("filament", "s", N_("Time left by the filament used")),
            ("file", "s", N_("Time left by the part of the file read")),
            ("layer", "s", N_("Time left by the layers done")),
            ("slicer", "s", N_("Time left by the slicer")),
        ),
    ),
)
