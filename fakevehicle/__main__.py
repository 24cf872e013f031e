"""`python -m fakevehicle`."""

from fakevehicle.cli import main

if __name__ == "__main__":
    main()
