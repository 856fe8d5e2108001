// What the board's own web interface does with it: node connectors.js URL PASSWORD; prints JSON.
// The modules are looked for in the folder of NODE_PATH.

"use strict";

const { JSDOM } = require("jsdom");

const [url, password] = process.argv.slice(2);
const page = new JSDOM("", { url });
for (const name of ["XMLHttpRequest", "WebSocket", "Blob", "File", "FileReader", "FormData"]) {
    global[name] = page.window[name];
}
global.status = undefined;

const { connect, DefaultSettings } = require("@duet3d/connectors");

const SQUARE = "0:/gcodes/square.gcode";
const FILE = "0:/gcodes/sent.g";
const TEXT = "G28\nG1 X1\n";

async function tried() {
    const settings = { ...DefaultSettings, protocol: "http:", password };
    const connection = await connect(new URL(url).host, settings);
    let update, failure;
    const updated = new Promise((resolve) => (update = resolve));
    connection.setCallbacks({
        onConnectProgress() {},
        onUpdate: update,
        onConnectionError: (_, problem) => (failure = String(problem)),
        onReconnected() {},
        onVolumeChanged() {},
    });
    await updated;
    const found = { kind: connection.constructor.name };
    found.reply = await connection.sendCode("M115", false);
    await connection.upload(FILE, TEXT);
    found.text = await connection.download(FILE, "text");
    found.files = (await connection.getFileList("0:/gcodes")).map((file) => file.name);
    const information = await connection.getFileInfo(SQUARE, true);
    found.layers = information.numLayers;
    found.pictures = information.thumbnails.map((picture) => picture.data.length);
    await connection.makeDirectory("0:/gcodes/made");
    await connection.move(FILE, "0:/gcodes/made/moved.g", true);
    found.moved = (await connection.getFileList("0:/gcodes/made")).map((file) => file.name);
    await connection.delete("0:/gcodes/made/moved.g");
    found.left = await connection.getFileList("0:/gcodes/made");
    await connection.disconnect();
    found.failure = failure || null;
    return found;
}

tried().then(
    (found) => {
        console.log(JSON.stringify(found));
        process.exit(0);
    },
    (problem) => {
        console.error(problem);
        process.exit(1);
    },
);
