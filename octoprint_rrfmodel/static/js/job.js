/* The sub-view Job: the print that the board runs from its card, its layers, objects and times. */
$(function () {
    const GCODES = "0:/gcodes/";
    /** States in which a job is there, and those in which it goes on. */
    const WITH_JOB = ["processing", "simulating", "pausing", "paused", "resuming", "cancelling"];
    const GOING_ON = ["processing", "simulating", "resuming"];
    const LATEST_LAYERS = 30;
    const RETRY_MS = 30000;
    const MOST_ATTEMPTS = 5;

    const {list, isNumber} = RRFModel;

    /** The name of a file that is only selected is told as that of the last one. */
    const pathOf = (job, status) =>
        (job.file || {}).fileName || (!WITH_JOB.includes(status) && job.lastFileName) || "";

    function RrfModelJobViewModel(parameters) {
        const self = this;
        const core = parameters[0];
        const model = core.modelOfView("job");
        const history = RRFModel.historyOf(core);
        const isOpen = core.isShown("job");
        const show = RRFModel.show;
        let element;

        self.isShown = ko.pureComputed(() => core.isRrf() && core.view() === "job");
        self.mayControl = core.mayControl;

        const job = ko.pureComputed(() => model("job") || {});
        const file = ko.pureComputed(() => job().file || {});
        const status = ko.pureComputed(() => (model("state") || {}).status || "");

        //~~ the file

        self.hasJob = ko.pureComputed(() => WITH_JOB.includes(status()));
        self.statusText = ko.pureComputed(() => RRFModel.words.status[status()] || status());

        const nameOf = (path) =>
            path && path.startsWith(GCODES) ? path.slice(GCODES.length) : path || "";

        self.path = ko.pureComputed(() => pathOf(job(), status()));
        self.name = ko.pureComputed(() => nameOf(self.path()));

        const size = (bytes) =>
            bytes < 1e6 ? (bytes / 1e3).toFixed(1) + " kB" : (bytes / 1e6).toFixed(1) + " MB";

        const metres = (lengths) =>
            list(lengths)
                .filter(isNumber)
                .map((length) => (length / 1000).toFixed(2) + " m")
                .join(" + ");

        const millimetres = (value) => (value > 0 ? show.fixed(value, 2) + " mm" : "");

        const texts = (table) =>
            _.mapValues(table, (text) => ko.pureComputed(() => text() || ""));

        self.facts = texts({
            slicer: () => file().generatedBy,
            size: () => isNumber(file().size) && size(file().size),
            height: () => millimetres(file().height),
            layerHeight: () => millimetres(file().layerHeight),
            filament: () => metres(file().filament),
            printTime: () => file().printTime && show.duration(file().printTime),
            simulatedTime: () => file().simulatedTime && show.duration(file().simulatedTime),
            modified: () => String(file().lastModified || "").replace("T", " ")
        });

        //~~ its picture

        const attempt = ko.observable(0);
        let retrying;

        self.hasPicture = ko.observable(false);
        self.picture = ko.pureComputed(function () {
            const has = list(file().thumbnails).length > 0;
            if (!has || !self.path()) return null;
            // a file that was sliced anew has another picture under its old name
            const version = [file().size, file().lastModified, attempt()].join("-");
            const query = $.param({path: self.path(), v: version});
            return OctoPrint.getBlueprintUrl("rrfmodel") + "thumbnail?" + query;
        });
        self.pictureCame = () => self.hasPicture(true);
        // the machine may have been busy
        self.pictureFailed = function () {
            self.hasPicture(false);
            window.clearTimeout(retrying);
            if (attempt() < MOST_ATTEMPTS)
                retrying = window.setTimeout(() => attempt(attempt() + 1), RETRY_MS);
        };
        self.picture.subscribe(() => self.hasPicture(false));
        self.path.subscribe(() => attempt(0));

        //~~ how far it is

        const fraction = ko.pureComputed(function () {
            const position = job().filePosition;
            const whole = file().size;
            return isNumber(position) && whole > 0 ? Math.min(position / whole, 1) : 0;
        });
        self.percent = ko.pureComputed(() => Math.floor(fraction() * 1000) / 10);
        self.percentText = ko.pureComputed(() => self.percent().toFixed(1) + " %");

        self.layerText = ko.pureComputed(function () {
            const layer = isNumber(job().layer) ? job().layer : "–";
            return file().numLayers ? layer + " / " + file().numLayers : String(layer);
        });
        self.layerTime = ko.pureComputed(() => show.duration(job().layerTime));

        /** What is left of a time that was told for the whole, after what has been printed. */
        const rest = function (seconds) {
            if (!isNumber(seconds) || !isNumber(job().duration)) return undefined;
            return Math.max(0, seconds - job().duration + (job().warmUpDuration || 0));
        };

        const times = (table) => texts(_.mapValues(table, (time) => () => show.duration(time())));
        const left = (name) => () => (job().timesLeft || {})[name];

        self.left = times({
            file: left("file"),
            filament: left("filament"),
            slicer: left("slicer"),
            simulation: () => rest(file().simulatedTime)
        });
        self.spent = times({
            duration: () => job().duration,
            warmUp: () => job().warmUpDuration,
            paused: () => job().pauseDuration
        });

        //~~ what can be done with it

        const act = (action) => () => core.command("job", {action: action});
        /** Asks first, and does it only if it is still the same file by then. */
        const asked = function (title, message, proceed, onproceed) {
            const path = self.path();
            core.confirm(title, message, proceed, function () {
                if (path === nowPrinted()) onproceed();
                else core.notify(gettext("Nothing was done: it is another print by now."));
            });
        };
        // the page's own view stands still while it is hidden
        const nowPrinted = () => pathOf(core.latest.job || {}, (core.latest.state || {}).status);

        self.mayPause = ko.pureComputed(() => GOING_ON.includes(status()));
        self.mayResume = ko.pureComputed(() => status() === "paused");
        self.mayCancel = ko.pureComputed(() => self.hasJob() && status() !== "cancelling");
        self.pause = act("pause");
        self.resume = act("resume");
        self.cancel = () =>
            asked(
                gettext("Cancel the print?"),
                gettext("It can't be taken up again."),
                gettext("Cancel the print"),
                act("cancel")
            );

        const begin = (action, path) => core.command("job", {action: action, path: path});
        self.start = function () {
            const path = self.path();
            asked(
                gettext("Start the print?"),
                gettext("The machine heats up and moves. Its bed has to be clear."),
                gettext("Start"),
                () => begin("start", path)
            );
        };
        self.simulate = () => begin("simulate", self.path());
        // a job may outlast the loss of the motors' supply
        self.mayStart = ko.pureComputed(() => !self.hasJob() && status() !== "off");
        self.maySelected = ko.pureComputed(
            () => self.mayStart() && !!self.path() && !self.last()
        );

        //~~ objects

        const range = (ends) =>
            list(ends).length === 2 && ends.every(isNumber) ? ends.map(Math.round).join("…") : "–";

        self.objects = RRFModel.rows(
            function () {
                const build = job().build || {};
                return list(build.objects).map((each, index) => ({
                    key: index,
                    name:
                        (each && each.name) ||
                        _.sprintf(gettext("Object %(number)s"), {number: index + 1}),
                    place: each ? "X " + range(each.x) + ", Y " + range(each.y) : "",
                    isCurrent: build.currentObject === index,
                    isCancelled: !!(each && each.cancelled)
                }));
            },
            function (row) {
                const send = (action) => () =>
                    core.command("object", {index: row.key, action: action});
                row.cancel = () =>
                    asked(
                        gettext("Leave this object out?"),
                        _.sprintf(gettext("The rest of object %(number)s isn't printed."), {
                            number: row.key + 1
                        }),
                        gettext("Leave it out"),
                        send("cancel")
                    );
                row.resume = send("resume");
                row.stateText = ko.pureComputed(function () {
                    if (row.isCancelled()) return gettext("left out");
                    return row.isCurrent() ? gettext("printed now") : "";
                });
            }
        );

        //~~ the last job

        /** How it ended only a single-board computer tells. One without a time was only selected. */
        self.last = ko.pureComputed(function () {
            const told = job();
            const isIt = self.path() === told.lastFileName && told.lastDuration;
            if (self.hasJob() || !isIt) return null;
            return {
                name: nameOf(told.lastFileName),
                duration: show.duration(told.lastDuration),
                warmUp: show.duration(told.lastWarmUpDuration),
                isAborted: told.lastFileAborted,
                isCancelled: told.lastFileCancelled,
                isSimulated: told.lastFileSimulated
            };
        });

        //~~ layers

        self.allLayers = ko.observable(true);
        const layers = ko.pureComputed(function () {
            history.revision();
            return self.allLayers() ? history.layers : history.layers.slice(-LATEST_LAYERS);
        });
        self.hasLayers = ko.pureComputed(() => layers().length > 0);

        /** The layer under the pointer; else the last one that is through. */
        const pointed = ko.observable(null);
        self.layerFacts = ko.pureComputed(function () {
            const layer = pointed() || layers()[layers().length - 1];
            if (!layer) return "";
            const title = _.sprintf(gettext("Layer %(number)s"), {number: layer.layer});
            const parts = [show.duration(layer.seconds), "Z " + (millimetres(layer.height) || "–")];
            if (isNumber(layer.filament)) parts.push(show.fixed(layer.filament, 0) + " mm");
            return title + ": " + parts.join(", ");
        });
        self.layersText = ko.pureComputed(function () {
            const sum = layers().reduce((seconds, layer) => seconds + layer.seconds, 0);
            return _.sprintf(gettext("Times of %(count)s layers, %(average)s on average"), {
                count: layers().length,
                average: show.duration(sum / layers().length)
            });
        });

        const draw = RRFModel.drawSoon(
            () => element,
            function () {
                const colour = window.getComputedStyle(element);
                const bars = {
                    color: colour.getPropertyValue("--rrfmodel-series-1").trim(),
                    data: layers().map((layer) => [layer.layer, layer.seconds]),
                    bars: {show: true, align: "center", barWidth: 0.8, lineWidth: 0, fill: 0.9}
                };
                $.plot(
                    $(element),
                    [bars],
                    RRFModel.chartOptions(element, {
                        grid: {hoverable: true},
                        xaxis: {minTickSize: 1, tickDecimals: 0},
                        yaxis: {min: 0, tickFormatter: (value) => show.duration(value)}
                    })
                );
            }
        );

        ko.computed(function () {
            layers();
            if (isOpen() && self.isShown()) draw();
        });

        self.onAfterBinding = function () {
            element = document.querySelector("#rrfmodel_job .rrfmodel-plot");
            $(element).on("plothover", (_event, _position, item) =>
                pointed(item && item.dataIndex < layers().length ? layers()[item.dataIndex] : null)
            );
            draw();
        };
    }

    OCTOPRINT_VIEWMODELS.push({
        construct: RrfModelJobViewModel,
        dependencies: ["rrfModelViewModel"],
        elements: ["#rrfmodel_job"]
    });
});
