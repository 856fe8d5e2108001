"""What klipper-tui's connection sees of a printer: ``python klipper_tui_client.py PORT``.

Prints JSON. It knows neither a prefix nor a key, so that a proxy has to give both.
"""

import asyncio
import json
import sys

from klipper_tui.moonraker import MoonrakerClient


async def tried(port):
    client = MoonrakerClient("127.0.0.1", int(port))
    seen, said = asyncio.Event(), []
    client.on_status(lambda status: seen.set())
    client.on_gcode_response(said.append)
    running = asyncio.create_task(client.run())
    await asyncio.wait_for(seen.wait(), 30)
    found = {"state": client.klippy_state, "objects": sorted(client.status)}
    found["answer"] = await client.gcode("M115")
    while not any("FIRMWARE" in line for line in said):
        await asyncio.sleep(0.05)
    running.cancel()
    return found


print(json.dumps(asyncio.run(tried(sys.argv[1]))))
