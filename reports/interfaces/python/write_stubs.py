"""Writes the type stubs of the package from the table of options that its extension holds: write_stubs.py PACKAGE FILE"""
import pathlib
import sys


def type_text(row):
    if row["kind"] == "choice":
        return "Literal[" + ", ".join(f'"{name}"' for name in row["choices"]) + "]"
    return "Mapping[int, float]" if row["kind"] == "label_numbers" else row["kind"]


def stubs(rows, presets):
    template = (pathlib.Path(__file__).parent / "stubs.pyi.in").read_text()
    options = "\n".join(f"    {row['keyword']}: {type_text(row)} | None = None," for row in rows)
    return template.replace("@PRESETS@", ", ".join(f'"{name}"' for name in presets)).replace("@OPTIONS@", options)


if __name__ == "__main__":
    sys.path.insert(0, sys.argv[1])  # the extension alone, which needs no numpy
    import _core

    pathlib.Path(sys.argv[2]).write_text(stubs(_core.option_rows(), _core.preset_names()))
