"""What duetwebapi does with a board: ``python duetwebapi_client.py URL``; prints JSON.

It sends neither checksums nor keys, and no password: the old kind of client.
"""

import contextlib
import json
import sys
import time

from duetwebapi import DuetWebAPI

FILE = "sent.g"
TEXT = "G28\nG1 X1\n"


def reply(board, code):
    """Return the reply to a command, which may come later."""
    said = board.send_code(code)
    text = said.get("response", "") if isinstance(said, dict) else str(said)
    end = time.monotonic() + 5
    while not text.strip() and time.monotonic() < end:
        text = str(board.send_code("M115").get("response", ""))
    return text


board = DuetWebAPI(sys.argv[1])
# behind a computer it has no sessions
with contextlib.suppress(NotImplementedError):
    board.connect()
board.upload_file(TEXT.encode(), FILE, "gcodes")
found = {
    "kind": type(board).__name__,
    "status": board.get_model("state")["status"],
    "reply": reply(board, "M115"),
    "files": [entry["name"] for entry in board.get_directory("gcodes")],
    "size": board.get_fileinfo(FILE, "gcodes")["size"],
}
board.delete_file(FILE, "gcodes")
found["left"] = [entry["name"] for entry in board.get_directory("gcodes")]
with contextlib.suppress(NotImplementedError):
    board.disconnect()
print(json.dumps(found))
