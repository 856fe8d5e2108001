"""RepRapFirmware's side of the border: the object model, its text form, its rules.

Nothing in this package imports OctoPrint, Flask, Tornado or its own parent package, and
nothing here sends or receives a byte: lines come in as text, decisions go out as values.
``tests/test_layering.py`` holds the border. What flows where:

    line -> reply -> merge -> store -> views        (what the board says)
    operation -> table -> G-code                    (what the board is told)
"""
