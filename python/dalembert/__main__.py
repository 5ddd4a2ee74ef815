"""The command: ``python -m dalembert`` and, installed, ``dalembert``."""

import signal
import sys

from . import _core


def main() -> int:
    # The command computes without the interpreter: Ctrl-C ends it at once.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _core.main(["dalembert", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
