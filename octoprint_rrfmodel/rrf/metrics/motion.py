"""Metrics of what moves: axes, extruders, the bed's mesh, and the job from the card."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ..views.job import WITHOUT_JOB, progress
from ..views.machine import array, mapping
from .metric import GAUGE, Metric, Model, Sample, Samples, Sources, at, each, indexed, one, positive

TIME_SOURCES = ("file", "filament", "slicer", "layer")
"""What ``job.timesLeft`` is reckoned from; ``layer`` up to 3.4."""


def _axes(model: Model) -> Iterator[tuple[str, Mapping[str, Any]]]:
    for axis in array(at(model, "move.axes")):
        letter = mapping(axis).get("letter")
        if isinstance(letter, str):
            yield letter, axis


_extruders = indexed("move.extruders")


def _pressure_advances(sources: Sources) -> Iterator[Sample]:
    for index, extruder in _extruders(sources.model):
        # from 3.7 on an object, with the names of its model's constants
        advance = mapping(extruder.get("pressAdv"))
        yield (index,), advance.get("k0", advance.get("k", extruder.get("pressureAdvance")))


def _speed_factor(sources: Sources) -> Iterator[Sample]:
    move = mapping(sources.model.get("move"))
    # from 3.7 on each motion system has its own
    systems = array(move.get("motionSystems"))
    yield (), at(systems[0] if systems else move, "speedFactor")


def _has_job(model: Model) -> bool:
    """Return whether what ``job`` says holds: M408 goes on telling of the last one.

    A simulation fills it as well.
    """
    status = at(model, "state.status")
    return status == "simulating" or status not in WITHOUT_JOB


def _of_job(samples: Samples) -> Samples:
    """Return what gives those values while there is a job."""

    def samples_of_job(sources: Sources) -> Iterator[Sample]:
        if _has_job(sources.model):
            yield from samples(sources)

    return samples_of_job


def _progress(sources: Sources) -> Iterator[Sample]:
    yield (), progress(sources.model)


def _times_left(sources: Sources) -> Iterator[Sample]:
    left = at(sources.model, "job.timesLeft")
    for source in TIME_SOURCES:
        yield (source,), at(left, source)


METRICS = (
    Metric(
        "rrf_axis_position_millimeters",
        GAUGE,
        "Machine position of an axis; degrees for one that turns.",
        ("axis",),
        each(_axes, "machinePosition"),
    ),
    Metric(
        "rrf_axis_user_position_millimeters",
        GAUGE,
        "Position of an axis in the coordinates in use.",
        ("axis",),
        each(_axes, "userPosition"),
    ),
    Metric("rrf_axis_homed", GAUGE, "Whether an axis is homed.", ("axis",), each(_axes, "homed")),
    Metric(
        "rrf_axis_babystep_millimeters",
        GAUGE,
        "Baby step of an axis.",
        ("axis",),
        each(_axes, "babystep"),
    ),
    Metric(
        "rrf_axis_min_millimeters",
        GAUGE,
        "Lowest position of an axis.",
        ("axis",),
        each(_axes, "min"),
    ),
    Metric(
        "rrf_axis_max_millimeters",
        GAUGE,
        "Highest position of an axis.",
        ("axis",),
        each(_axes, "max"),
    ),
    Metric(
        "rrf_extruder_position_millimeters",
        GAUGE,
        "Position of an extruder.",
        ("extruder",),
        each(_extruders, "position"),
    ),
    Metric(
        "rrf_extruder_factor_ratio",
        GAUGE,
        "Extrusion factor, 1 for 100 %.",
        ("extruder",),
        each(_extruders, "factor"),
    ),
    Metric(
        "rrf_extruder_pressure_advance_seconds",
        GAUGE,
        "Pressure advance of an extruder.",
        ("extruder",),
        _pressure_advances,
    ),
    Metric("rrf_speed_factor_ratio", GAUGE, "Speed factor, 1 for 100 %.", (), _speed_factor),
    Metric(
        "rrf_move_requested_speed_millimeters_per_second",
        GAUGE,
        "Speed that the current move asks for.",
        (),
        one("move.currentMove.requestedSpeed"),
    ),
    Metric(
        "rrf_move_top_speed_millimeters_per_second",
        GAUGE,
        "Highest speed that the current move reaches.",
        (),
        one("move.currentMove.topSpeed"),
    ),
    Metric(
        "rrf_move_extrusion_rate_millimeters_per_second",
        GAUGE,
        "Filament that the current move feeds.",
        (),
        one("move.currentMove.extrusionRate"),
    ),
    Metric(
        "rrf_mesh_deviation_mean_millimeters",
        GAUGE,
        "Mean error of the bed's mesh.",
        (),
        one("move.compensation.meshDeviation.mean"),
    ),
    Metric(
        "rrf_mesh_deviation_rms_millimeters",
        GAUGE,
        "Root mean square deviation of the bed's mesh.",
        (),
        one("move.compensation.meshDeviation.deviation"),
    ),
    Metric(
        "rrf_job_progress_ratio",
        GAUGE,
        "Part of the job's file that was read, 0 to 1.",
        (),
        _of_job(_progress),
    ),
    Metric(
        "rrf_job_file_size_bytes",
        GAUGE,
        "Size of the job's file.",
        (),
        _of_job(one("job.file.size", positive)),
    ),
    Metric(
        "rrf_job_file_position_bytes",
        GAUGE,
        "How much of the job's file was read.",
        (),
        _of_job(one("job.filePosition")),
    ),
    Metric(
        "rrf_job_layer",
        GAUGE,
        "Layer being printed, counted from 1.",
        (),
        _of_job(one("job.layer")),
    ),
    Metric(
        "rrf_job_layers",
        GAUGE,
        "Layers of the job.",
        (),
        _of_job(one("job.file.numLayers", positive)),
    ),
    Metric(
        "rrf_job_duration_seconds",
        GAUGE,
        "Duration of the job without its pauses.",
        (),
        _of_job(one("job.duration")),
    ),
    Metric(
        "rrf_job_pause_duration_seconds",
        GAUGE,
        "Duration of the job's pauses.",
        (),
        _of_job(one("job.pauseDuration")),
    ),
    Metric(
        "rrf_job_warm_up_duration_seconds",
        GAUGE,
        "Time that the job has waited for temperatures.",
        (),
        _of_job(one("job.warmUpDuration")),
    ),
    Metric(
        "rrf_job_layer_time_seconds",
        GAUGE,
        "Time spent on the current layer.",
        (),
        _of_job(one("job.layerTime")),
    ),
    Metric(
        "rrf_job_time_left_seconds",
        GAUGE,
        "Time that the job still needs, by what it is reckoned from.",
        ("source",),
        _of_job(_times_left),
    ),
    Metric(
        "rrf_job_raw_extrusion_millimeters",
        GAUGE,
        "Filament that the job has used, without extrusion factors.",
        (),
        _of_job(one("job.rawExtrusion")),
    ),
    Metric(
        "rrf_job_last_duration_seconds",
        GAUGE,
        "Duration of the last job.",
        (),
        one("job.lastDuration"),
    ),
)
