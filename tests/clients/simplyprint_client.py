"""What simplyprint-duet3d does with a board: ``python simplyprint_client.py URL PASSWORD``.

Prints JSON.
"""

import asyncio
import io
import json
import sys

from simplyprint_duet3d.duet.api import RepRapFirmware
from simplyprint_duet3d.duet.model import DuetPrinterModel

FILE = "0:/gcodes/sent.g"
TEXT = b"G28\nG1 X1\n"


async def tick(printer):
    """Let it follow the board, without which it never hears of a reply."""
    while True:
        await printer.tick()
        await asyncio.sleep(0.1)


async def tried(url, password):
    printer = DuetPrinterModel(api=RepRapFirmware(address=url, password=password))
    await printer.connect()
    ticking = asyncio.create_task(tick(printer))
    found = {"status": printer.om["state"]["status"], "boards": printer.om["boards"][0]["name"]}
    found["reply"] = await printer.gcode("M115", no_reply=False)
    file = io.BytesIO(TEXT)
    file.name = FILE
    await printer.upload_stream(filepath=FILE, file=file)
    found["size"] = (await printer.fileinfo(FILE))["size"]
    received = [chunk async for chunk in printer.download(FILE)]
    found["text"] = b"".join(c for c in received if isinstance(c, bytes)).decode()
    await printer.delete(FILE)
    ticking.cancel()
    await printer.close()
    return found


print(json.dumps(asyncio.run(tried(*sys.argv[1:3])), default=str))
