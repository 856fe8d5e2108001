"""``GET /plugin/rrfmodel/heightmap``: the mesh in use, read from the machine's card."""

import asyncio

from flask_babel import gettext

from .live_api import WAIT_SECONDS, LiveModelHandler


class HeightMapHandler(LiveModelHandler):
    """Answers with the mesh; on Tornado's loop, as it may have to be read first."""

    async def get(self):
        """Answer with grid and points; 404 where there is none, 409 over a serial line."""
        reading = self._questions.height_map()
        if reading is None:
            self._refuse(
                409,
                gettext(
                    "The height map is a file of the machine's, which can be read over the network"
                    " alone."
                ),
            )
            return
        question = asyncio.wait_for(asyncio.wrap_future(reading), WAIT_SECONDS)
        found = await self._answer_of(question)
        if found is not None:
            file, mesh = found
            self.write(mesh.members(file))
