"""Fail where tests have gone too few ways: ``python tools/branches.py coverage.json 95``.

``coverage report`` weighs lines and branches together, which lines decide.
"""

import json
import sys
from pathlib import Path


def main(path, least):
    totals = json.loads(Path(path).read_text("utf-8"))["totals"]
    share = 100 * totals["covered_branches"] / totals["num_branches"]
    print(f"branches: {share:.1f} % of {totals['num_branches']}, at least {least} %")
    return share < float(least)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
