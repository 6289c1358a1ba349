"""`python -m rapidsim`."""

from rapidsim.cli import main

if __name__ == "__main__":
    main()
