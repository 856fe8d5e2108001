"""The table of scenes, and the order in which they come."""

import random

from . import scenes_card, scenes_line, scenes_machine, scenes_print

SCENES = (
    *scenes_print.SCENES,
    *scenes_card.SCENES,
    *scenes_machine.SCENES,
    *scenes_line.SCENES,
)

BY_NAME = {scene.name: scene for scene in SCENES}

FAULTS = (0, 1, 1, 2, 2)
"""How many faults come along, where a scene may have any."""


def turn_of(seed, turn, names=tuple(BY_NAME)):
    """Return the scene of a turn, its faults, and its chance; the same for the same seed."""
    round_, place = divmod(turn, len(names))
    deck = list(names)
    random.Random(f"{seed} round {round_}").shuffle(deck)
    chance = random.Random(f"{seed} turn {turn}")
    scene = BY_NAME[deck[place]]
    count = chance.choice(FAULTS) if scene.companions else 0
    names_seen, chosen = set(), []
    for companion in chance.sample(scene.companions, len(scene.companions)):
        if len(chosen) < count and companion.name not in names_seen:
            names_seen.add(companion.name)
            chosen.append(companion)
    return scene, chosen, chance
