"""A week of prints, faults and visitors in a few minutes, without harm: ``make endurance``.

* ``__main__``: a process for each host, their tables, the verdict.
* ``week``: one host's week: which scene comes next, with which faults, and what it left behind.
* ``rig``: OctoPrint, the board and what was seen of both; what holds after each scene.
* ``printing``: a print that is streamed, compared line by line.
* ``scenes``: the table of scenes, made of ``scenes_print``, ``scenes_card``, ``scenes_machine`` and
  ``scenes_line``; ``companions``: the faults that may come with them.
* ``audience``: pages, sockets and requests that come and go meanwhile; ``picture``: a subscriber
  that stays.
* ``network``: the like with a board on the network, in OctoPrint 2.0, with ``network_rig`` and
  ``scenes_network``.
* ``levels``: what was measured, and whether it stayed level.
"""
