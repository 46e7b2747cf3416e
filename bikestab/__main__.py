"""``python -m bikestab``: the command line. The one module of the library that knows of it."""

from bikestab_cli.main import main

if __name__ == "__main__":  # worker processes import it under another name
    main("python -m bikestab")
