"""Writes the type stubs of the package from the table of options that its extension holds: write_stubs.py PACKAGE FILE"""
import pathlib
import sys


def type_text(row):
    if row["kind"] == "choice":
        return "Literal[" + ", ".join(f'"{name}"' for name in row["choices"]) + "]"
    return "Mapping[int, float]" if row["kind"] == "label_numbers" else row["kind"]


_CHOICES = {"bool": "bool", "int": "int", "labels": "int | Sequence[int]", "names": "str | PathLike[str] | Mapping[int, str]"}

_WRITE = """    def write(
        self,
        path: str | PathLike[str],
        *,
        format: Literal[@FORMATS@] | None = None,
        split_interfaces: bool = False,
        coordinates: Literal["LPS", "RAS"] = "LPS",
    ) -> None: ..."""


def quoted(names):
    return ", ".join(f'"{name}"' for name in names)


def stubs(core):
    text = (pathlib.Path(__file__).parent / "stubs.pyi.in").read_text()
    options = "\n".join(f"    {row['keyword']}: {type_text(row)} | None = None," for row in core.option_rows())
    choices = "\n".join(f"    {row['keyword']}: {_CHOICES[row['kind']]} | None = None," for row in core.input_rows())
    for mark, value in (("@WRITE@", _WRITE), ("@FORMATS@", quoted(core.mesh_format_names())), ("@CHOICES@", choices),
                        ("@OPTIONS@", options), ("@PRESETS@", quoted(core.preset_names()))):
        text = text.replace(mark, value)
    return text


if __name__ == "__main__":
    sys.path.insert(0, sys.argv[1])  # the extension alone, which needs no numpy
    import _core

    pathlib.Path(sys.argv[2]).write_text(stubs(_core))
