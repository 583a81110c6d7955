"""Runs the attacks on a service and on the command line, one after the other, and prints a table of results.

    python3 tests/attacks/run.py build/release/farol [NAME...]

Exit code 0 when every attack was withstood. Names are those of the functions; a beginning is enough."""
import sys
import time
import traceback

import command_line  # noqa: F401  (each module registers its attacks)
import documents  # noqa: F401
import files  # noqa: F401
import protocol  # noqa: F401
import taken_worker  # noqa: F401
from common import ATTACKS, Failed


def main():
    binary, names = sys.argv[1], sys.argv[2:]
    chosen = [one for one in ATTACKS if not names or any(one.__name__.startswith(name) for name in names)]
    if not chosen:
        sys.exit(f"no attack is called {' or '.join(names)}; there are "
                 + ", ".join(one.__name__ for one in ATTACKS))
    failed = 0
    for one in chosen:
        begin = time.monotonic()
        try:
            result, word = one(binary), "withstood"
        except Failed as fault:
            result, word = str(fault), "FAILED"
        except Exception:  # a fault of the program itself must not pass for a result
            result, word = traceback.format_exc(limit=3), "FAILED"
        failed += word == "FAILED"
        print(f"{one.__name__:28} {word:9} {time.monotonic() - begin:5.1f} s  {result}", flush=True)
    print(f"{len(chosen) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
