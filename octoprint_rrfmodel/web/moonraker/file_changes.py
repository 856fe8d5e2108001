"""Methods that change files: brought, deleted, moved, put into folders."""

import hashlib
from contextlib import suppress

from flask_babel import gettext

from ...host.answers import RequestRefused
from .methods import CONTROL, Method
from .places import GCODES, below, place_of

DELETE = "FILES_DELETE"
UPLOAD = "FILES_UPLOAD"

PIECE = 1 << 20

CREATED = 201
CHECKSUM_DIFFERS = 422


class FileChanges:
    """Makes changes through OctoPrint; ``roots`` are ``Roots``, ``prints`` begins prints."""

    def __init__(self, roots, prints):
        self._roots = roots
        self._prints = prints

    def rows(self):
        """Return the rows."""
        return (
            Method("server.files.upload", self._upload, CONTROL, verbs=("POST",), status=CREATED),
            Method(
                "server.files.delete_file",
                self._delete_file,
                CONTROL,
                verbs=("DELETE",),
                below="server/files",
            ),
            Method("server.files.move", self._move, CONTROL, verbs=("POST",)),
            Method("server.files.post_directory", self._make_folder, CONTROL),
            Method("server.files.delete_directory", self._delete_folder, CONTROL),
        )

    def _upload(self, call):
        call.needs(UPLOAD)
        if call.upload is None:
            raise RequestRefused(
                400, gettext("A file is sent as multipart/form-data over HTTP, as file.")
            )
        place = _target(call)
        files = self._changeable(place).files
        target = files.name_for(place.path)
        if files.find(target) is not None:
            call.needs(DELETE)
        is_printed = call.flag("print")
        if is_printed:
            self._prints.check(place.root, call)
        _check_sum(call.upload.path, call.text("checksum", ""))
        added = files.add(target, call.upload.path, call.caller.name)
        self._roots.of(place).forget(added)
        began = is_printed and self._began(call, place.root, added)
        files.tell_of_upload(added, began)
        return {
            "item": self._roots.item(place._replace(path=added)),
            "print_started": began,
            "print_queued": False,
            "action": "create_file",
        }

    def _began(self, call, root, path):
        """Return whether a print of what was brought has begun; the file is there either way."""
        with suppress(RequestRefused):
            self._prints.start(root, path, call)
            return True
        return False

    def _delete_file(self, call):
        call.needs(DELETE)
        place, found = self._roots.thing(call.text("path"))
        if found.is_folder:
            raise RequestRefused(400, gettext("That is a folder."))
        self._changeable(place).files.delete(found)
        return {"item": self._roots.item(place), "action": "delete_file"}

    def _delete_folder(self, call):
        call.needs(DELETE)
        place, found = self._roots.thing(call.text("path"))
        if not found.is_folder or not place.path:
            raise RequestRefused(400, gettext("That is no folder that can be deleted."))
        root = self._changeable(place)
        if not call.flag("force") and root.inside(place.path):
            raise RequestRefused(409, gettext("The folder is not empty."))
        root.files.delete(found)
        return {"item": self._roots.item(place), "action": "delete_dir"}

    def _make_folder(self, call):
        call.needs(UPLOAD)
        place = place_of(call.text("path"))
        made = self._changeable(place).files.make_folder(place.path)
        return {"item": self._roots.item(place._replace(path=made)), "action": "create_dir"}

    def _move(self, call):
        call.needs(UPLOAD)
        call.needs(DELETE)
        source, found = self._roots.thing(call.text("source"))
        target = place_of(call.text("dest"))
        if source.root != target.root:
            raise RequestRefused(400, gettext("Files are moved within one root alone."))
        if not source.path:
            raise RequestRefused(400, gettext("A root can't be moved."))
        root = self._changeable(source)
        there = root.find(target.path)
        if there is not None and there.is_folder and there.path != found.path:
            target = target.at(source.name)
        moved = root.files.move(found, target.path)
        root.forget(moved)
        return {
            "item": self._roots.item(target._replace(path=moved)),
            "source_item": {"path": source.path, "root": source.root},
            "action": "move_dir" if found.is_folder else "move_file",
        }

    def _changeable(self, place):
        root = self._roots.of(place)
        if root.can_be_changed:
            return root
        raise RequestRefused(
            409,
            gettext(
                "The files on the machine's card can be changed over the network alone. Connect it"
                " that way, or print from OctoPrint."
            ),
        )


def _target(call):
    """Return where a file is to be put that is sent."""
    root = call.text("root", GCODES)
    folder, name = call.text("path", "").strip("/"), call.upload.name.strip("/")
    place = below(root, f"{folder}/{name}" if folder else name)
    if not place.path:
        raise RequestRefused(400, gettext("A file can't have that name."))
    return place


def _check_sum(path, wanted):
    if not wanted:
        return
    found = hashlib.sha256()
    with open(path, "rb") as file:
        while piece := file.read(PIECE):
            found.update(piece)
    if found.hexdigest() != wanted.strip().lower():
        raise RequestRefused(
            CHECKSUM_DIFFERS, gettext("The file has not come through whole. Send it again.")
        )
