"""What Klipper's clients send as a script: Klipper's commands, told in this machine's words.

    plan.planned(lines, at)       G-code, operations, what is done to a print; or ``Refused``
    moment.at_moment(world)       what that is decided from
    help.help_texts(world)        what there is, for ``printer.gcode.help``

One row for each command of Klipper's is in ``table``, by topic in ``heat``, ``move``, ``prints``
and ``tuning``; what has no counterpart is in ``refusals``, with the reason. The commands and their
parameters are those that Klipper documents; which of them clients send was read in
Mainsail 2.17, Fluidd, KlipperScreen, Mobileraker and moonraker-obico.
"""
