"""Machines whose tools, heaters and axes matter to what is said to them."""

from octoprint_rrfmodel.rrf.views.machine import Machine


def heater(state="off", current=21.0):
    return {"state": state, "current": current, "active": 0, "standby": 0}


def tool(number, heaters=(1,), extruders=(0,), standby=(0,)):
    return {
        "number": number,
        "heaters": list(heaters),
        "extruders": list(extruders),
        "standby": list(standby),
    }


def machine(version="3.5.3", tools=(), current=-1, is_current=True, homed=True, warm=True, **heat):
    return Machine(
        {
            "boards": [{"firmwareVersion": version}],
            "state": {"currentTool": current},
            "tools": list(tools),
            "heat": {
                "bedHeaters": [-1, 0],
                "chamberHeaters": [5],
                "coldExtrudeTemperature": 160,
                "heaters": [heater(current=220.0 if warm else 21.0)] * 6,
                **heat,
            },
            "move": {
                "noMovesBeforeHoming": True,
                "axes": [{"letter": letter, "homed": homed} for letter in "XYZ"],
            },
        },
        is_current,
    )
