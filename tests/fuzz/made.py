"""What the targets are fed with, besides lines (``hostile``)."""

import base64
import json

from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.card.qoi import MAGIC
from octoprint_rrfmodel.rrf.card.thumbnail import JPEG, JPEG_END, PNG
from tests.rrf.klipper.test_fuzz import TREES
from tests.rrf.klipper.test_fuzz import spoilt_models as spoilt
from tests.rrf.strategies import ANY_JSON, compact, model_reply

MODELS = spoilt() | TREES.filter(lambda tree: isinstance(tree, dict))

COMMANDS = st.builds(
    lambda gcode, words: " ".join([gcode, *words]),
    st.sampled_from(
        ("G1", "G91", "G28", "M104", "M140", "M141", "M221", "T0", "M111", "M291", "M20")
    ),
    st.lists(
        st.sampled_from(
            ("S0", "S60", "T1", "T0", "X5", "E5", "S" + "9" * 400, "T" + "9" * 400, "P", '"')
        )
        | st.text(max_size=5),
        max_size=3,
    ),
)

KEYS = st.lists(
    st.sampled_from(
        ["heat", ".", "[", "]", "[]", "[0]", "[-1]", "#", "heaters", "^", "[99999999999]", " ", '"']
    )
    | st.text(max_size=3),
    max_size=12,
).map("".join)

FLAGS = st.lists(
    st.sampled_from(list("dfinovaxr")) | st.integers(0, 10**12).map(str) | st.text(max_size=2),
    max_size=8,
).map("".join)


@st.composite
def cut(draw, texts):
    """A text with a piece left out, doubled, or replaced by something else."""
    text = draw(texts)
    start = draw(st.integers(0, len(text)))
    end = draw(st.integers(start, min(len(text), start + 40)))
    return (
        text[:start]
        + draw(
            st.sampled_from(["", text[start:end] * 2, "\0", '"', "}", "[", "é"])
            | st.text(max_size=6)
        )
        + text[end:]
    )


def damaged(texts):
    """Texts as they are, and as a line makes of them."""
    return texts | cut(texts) | cut(cut(texts))


ODD_KEYS = st.sampled_from(["", "heat", "move", "seqs", "state", "tools", "move.axes", "boards"])

MEMBERS = st.sampled_from(["status", "heaters", "time", "pos", "err", "temps", "params", "tools"])

MODEL_REPLIES = damaged(
    st.builds(
        model_reply, MODELS | ANY_JSON, ODD_KEYS, st.sampled_from(["d99fin", "d99vno", "d1vno"])
    )
    | st.builds(
        compact,
        st.dictionaries(
            st.sampled_from(
                ["status", "heaters", "time", "pos", "err", "seq", "temps", "params", "tools"]
            ),
            ANY_JSON,
        ),
    )
    | ANY_JSON.map(json.dumps)
)

ENTRIES = st.fixed_dictionaries(
    {},
    optional={
        "type": st.sampled_from(["f", "d", "x"]) | ANY_JSON,
        "name": st.sampled_from(["a.g", "A.G", "..", "/", "benchy.gcode", "ä.gcode", ""])
        | ANY_JSON,
        "size": st.integers(-5, 10**12) | ANY_JSON,
        "date": st.sampled_from(["2026-11-29T21:00:00", "2026-13-99", ""]) | ANY_JSON,
    },
)

PAGES = damaged(
    st.builds(
        lambda folder, first, files, after, more: compact(
            {"dir": folder, "first": first, "files": files, "next": after, **more}
        ),
        st.sampled_from(["0:/gcodes", "0:/gcodes/", "0:/macros", "1:/x"]) | ANY_JSON,
        st.integers(-1, 5) | ANY_JSON,
        st.lists(ENTRIES | ANY_JSON, max_size=5) | ANY_JSON,
        st.integers(-1, 9) | ANY_JSON,
        st.dictionaries(st.sampled_from(["err", "line", "x"]), ANY_JSON, max_size=2),
    )
)

FILE_REPLIES = damaged(
    st.fixed_dictionaries(
        {"err": st.sampled_from([0, 1]) | ANY_JSON},
        optional={
            "fileName": st.sampled_from(["a.gcode", ""]) | ANY_JSON,
            "size": st.integers() | ANY_JSON,
            "lastModified": ANY_JSON,
            "thumbnails": st.lists(
                st.fixed_dictionaries(
                    {"width": st.integers(-1, 400), "height": st.integers(-1, 400)},
                    optional={
                        "format": st.sampled_from(["png", "qoi", "jpeg", ""]) | ANY_JSON,
                        "offset": st.integers() | ANY_JSON,
                        "size": st.integers() | ANY_JSON,
                    },
                )
                | ANY_JSON,
                max_size=4,
            )
            | ANY_JSON,
            "thumbnail": st.fixed_dictionaries(
                {},
                optional={
                    "fileName": st.just("a.gcode") | ANY_JSON,
                    "offset": st.integers(0, 9) | ANY_JSON,
                    "data": st.text(max_size=20) | ANY_JSON,
                    "next": st.integers(0, 9) | ANY_JSON,
                    "err": st.sampled_from([0, 1]) | ANY_JSON,
                },
            )
            | ANY_JSON,
        },
    ).map(compact)
)

QOI_HEADER = st.builds(
    lambda width, height: MAGIC + width.to_bytes(4, "big") + height.to_bytes(4, "big") + b"\4\0",
    st.integers(0, 40) | st.integers(0, 2**32 - 1),
    st.integers(0, 40),
)

PICTURES = st.one_of(
    st.builds(lambda head, body: head + body, QOI_HEADER, st.binary(max_size=300)),
    st.builds(lambda body: PNG + body, st.binary(max_size=200)),
    st.builds(lambda body: JPEG + body + JPEG_END, st.binary(max_size=100)),
    st.binary(max_size=100),
).map(lambda data: base64.b64encode(data).decode())

METHODS = st.sampled_from(
    [
        *("server.info", "server.connection.identify", "printer.info", "printer.objects.list"),
        *("printer.objects.query", "printer.objects.subscribe", "nothing", ""),
        *("server.database.get_item", "server.database.post_item", "server.webcams.get_item"),
        *("server.files.get_directory", "server.files.metadata", "server.files.post_directory"),
        *("server.history.list", "server.history.delete_job", "printer.print.start"),
        *("machine.device_power.post_device", "access.oneshot_token", "access.login"),
    ]
)

WANTED = st.dictionaries(
    st.sampled_from(["toolhead", "extruder", "heaters", "gcode_move", "webhooks", "nothing"])
    | st.text(max_size=4),
    st.none()
    | st.lists(st.sampled_from(["temperature", "position", "x"]) | ANY_JSON, max_size=3)
    | ANY_JSON,
    max_size=3,
)

CALLS = st.fixed_dictionaries(
    {"jsonrpc": st.just("2.0") | ANY_JSON, "method": METHODS | ANY_JSON},
    optional={
        "id": st.integers() | st.floats() | ANY_JSON,
        "params": st.fixed_dictionaries({}, optional={"objects": WANTED | ANY_JSON}) | ANY_JSON,
    },
)

ODD_FRAMES = [
    '{"jsonrpc":"2.0","method":"server.info","id":1e999}',
    "[" * 5000,
    "1" * 5000,
    '"\\ud800"',
]

FRAMES = (
    damaged((CALLS | st.lists(CALLS, max_size=4)).map(json.dumps))
    | st.text()
    | st.sampled_from(ODD_FRAMES)
)

PIECES_OF_FILES = [
    *(b"if true", b"else", b"while", b"\n", b"\r\n", b'"', b";", b"G1 X1", b"M117 "),
    *(b"\xef\xbb\xbf", b"  ", b"N1 "),
]

FILES = st.lists(st.sampled_from(PIECES_OF_FILES) | st.binary(max_size=6), max_size=30)
