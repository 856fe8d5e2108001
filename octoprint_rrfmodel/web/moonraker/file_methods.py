"""Methods that tell of files: lists, folders, what is known of one, its pictures."""

from .methods import Method
from .places import GCODES, Place

LIST = "FILES_LIST"
UPLOAD = "FILES_UPLOAD"


class FileMethods:
    """Answers them; ``roots`` are ``Roots``."""

    def __init__(self, roots):
        self._roots = roots

    def rows(self):
        """Return the rows."""
        return (
            Method("server.files.roots", self._all_roots),
            Method("server.files.list", self._list),
            Method("server.files.get_directory", self._directory),
            Method("server.files.metadata", self._metadata),
            Method("server.files.metascan", self._scan, verbs=("POST",)),
            Method("server.files.thumbnails", self._thumbnails),
        )

    def _all_roots(self, call):
        call.needs(LIST)
        return self._roots.all()

    def _list(self, call):
        call.needs(LIST)
        root = self._roots.named(call.text("root", GCODES))
        return [
            {
                "path": each.path,
                "modified": each.modified,
                "size": each.size,
                "permissions": root.permissions,
            }
            for each in root.listed()
        ]

    def _directory(self, call):
        call.needs(LIST)
        place, _ = self._roots.thing(call.text("path", GCODES))
        root, is_extended = self._roots.of(place), call.flag("extended")
        inside = root.inside(place.path)
        return {
            "dirs": [_told(root, each, "dirname") for each in inside if each.is_folder],
            "files": [
                {**self._known(place.root, each, is_extended), **_told(root, each, "filename")}
                for each in inside
                if not each.is_folder
            ],
            "disk_usage": root.usage(),
            "root_info": {"name": root.root, "permissions": root.permissions},
        }

    def _known(self, root, found, is_extended):
        """Return what goes with a file in a list, for which no board is asked."""
        if not is_extended or not found.is_printable:
            return {}
        return self._roots.metadata(Place(root, found.path), found, is_asked=False)

    def _metadata(self, call):
        call.needs(LIST)
        return self._roots.metadata(*self._roots.file(call.text("filename")))

    def _scan(self, call):
        call.needs(UPLOAD)
        place, found = self._roots.file(call.text("filename"))
        root = self._roots.of(place)
        root.scan(found.path)
        return self._roots.metadata(place, found)

    def _thumbnails(self, call):
        call.needs(LIST)
        place, found = self._roots.file(call.text("filename"))
        told = self._roots.metadata(place, found)
        folder = told["filename"].rpartition("/")[0]
        return [
            {
                "width": each["width"],
                "height": each["height"],
                "size": each["size"],
                "thumbnail_path": f"{folder}/{each['relative_path']}".lstrip("/"),
            }
            for each in told.get("thumbnails", ())
        ]


def _told(root, found, name):
    return {
        "modified": found.modified,
        "size": found.size,
        "permissions": root.permissions,
        name: found.path.rpartition("/")[2],
    }
