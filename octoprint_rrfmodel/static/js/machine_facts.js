/* What the sub-view Machine only shows: how it moves, sensors, pins, boards, network, volumes. */
$(function () {
    const {list, numbered, object, isNumber} = RRFModel;
    /** Returns the members of a view model over the model of its view. */
    RRFModel.machineFacts = function (core, model) {
        const self = {};
        const show = RRFModel.show;
        const state = ko.pureComputed(() => object(model("state")));
        const sensors = ko.pureComputed(() => object(model("sensors")));
        const move = ko.pureComputed(() => object(model("move")));

        //~~ motion

        const withUnit = (value, unit, digits) =>
            isNumber(value) ? value.toFixed(digits === undefined ? 1 : digits) + " " + unit : "";

        /** G54 and so on by a number from 0. */
        const workplace = (number) =>
            isNumber(number) ? "G" + (number < 6 ? number + 54 : "59." + (number - 5)) : "";

        const shaping = (found) =>
            found.type && found.type !== "none"
                ? found.type + " " + withUnit(found.frequency, "Hz")
                : found.type;

        /** By model since 3.7, one number before. */
        const pressure = (extruder) =>
            isNumber(extruder.pressureAdvance)
                ? extruder.pressureAdvance
                : object(extruder.pressAdv).k0;

        const current = ko.pureComputed(() => object(move().currentMove));
        const tool = () =>
            list(model("tools")).find((each) => each && each.number === state().currentTool);

        /** Texts by the names that the template has labels for; empty where nothing is known. */
        self.motion = _.mapValues(
            {
                requested: () => withUnit(current().requestedSpeed, "mm/s"),
                top: () => withUnit(current().topSpeed, "mm/s"),
                acceleration: () => withUnit(current().acceleration, "mm/s²", 0),
                extrusion: () => withUnit(current().extrusionRate, "mm/s", 2),
                pressure: function () {
                    const known = list(move().extruders).map((each) => pressure(object(each)));
                    const text = known.map((each) => show.fixed(each, 3)).join(" / ");
                    return known.some(isNumber) ? text + " s" : "";
                },
                shaping: () => shaping(object(move().shaping)),
                retraction: () => withUnit(object(object(tool()).retraction).length, "mm", 2),
                workplace: () => workplace(move().workplaceNumber),
                running: () => (isNumber(state().upTime) ? show.duration(state().upTime) : "")
            },
            (text) => ko.pureComputed(text)
        );

        //~~ sensors and pins

        self.sensors = RRFModel.rows(() =>
            numbered(sensors().analog).map((found) => ({
                key: found.index,
                name:
                    found.item.name ||
                    _.sprintf(gettext("Sensor %(number)s"), {number: found.index}),
                value: show.degrees(found.item.lastReading)
            }))
        );

        self.inputs = RRFModel.rows(() =>
            numbered(sensors().gpIn).map((found) => ({
                key: found.index,
                value: isNumber(found.item.value) ? String(found.item.value) : "–"
            }))
        );
        self.outputs = RRFModel.rows(() =>
            numbered(state().gpOut).map((found) => ({
                key: found.index,
                value: show.percent(found.item.pwm)
            }))
        );

        //~~ boards, network, volumes

        /** Without what follows it of one build or another. */
        const versionOf = (board) => String(object(board).firmwareVersion || "").split(/[+ ]/)[0];
        self.boards = RRFModel.rows(() =>
            numbered(model("boards")).map(function (found) {
                const board = found.item;
                const main = list(model("boards"))[0];
                return {
                    key: found.index,
                    name: board.name || board.shortName || String(found.index),
                    version: board.firmwareVersion || "",
                    differs: !!board.firmwareVersion && versionOf(board) !== versionOf(main),
                    supply: withUnit(object(board.vIn).current, "V"),
                    twelve: withUnit(object(board.v12).current, "V"),
                    temperature: withUnit(object(board.mcuTemp).current, "°C")
                };
            })
        );

        self.interfaces = RRFModel.rows(() =>
            numbered(object(model("network")).interfaces).map((found) => ({
                key: found.index,
                type: found.item.type || "",
                address: found.item.actualIP || "",
                state: found.item.state || "",
                // an address and nothing else: it goes into a link
                link: /^\d{1,3}(\.\d{1,3}){3}$/.test(found.item.actualIP || "") &&
                    found.item.actualIP !== "0.0.0.0"
                        ? "http://" + found.item.actualIP + "/"
                        : ""
            }))
        );
        self.machineName = ko.pureComputed(() => object(model("network")).name || "");

        const gigabytes = (bytes) => (isNumber(bytes) ? withUnit(bytes / 1e9, "GB") : "–");
        self.volumes = RRFModel.rows(() =>
            numbered(model("volumes")).map((found) => ({
                key: found.index,
                name: found.item.name || found.item.path || String(found.index),
                text: found.item.mounted
                    ? _.sprintf(gettext("%(free)s of %(size)s free"), {
                          free: gigabytes(found.item.freeSpace),
                          size: gigabytes(found.item.capacity)
                      })
                    : gettext("not mounted")
            }))
        );
        return self;
    };
});
