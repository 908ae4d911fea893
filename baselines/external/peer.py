"""What the adapters of meshers from outside share: the command line, images, meshes, the report.

An adapter calls run(NAME, MODULES, PARAMETERS, MESH). Index mm are voxel indices times the spacing, as `LabelVolume` has them;
meshes are written in physical mm, LPS.
"""
import argparse
import contextlib
import importlib.util
import json
import os
import resource
import shutil
import sys
import time
from dataclasses import dataclass

EXIT_SUCCESS, EXIT_BAD_INPUT, EXIT_FAILED = 0, 2, 3


class BadInput(Exception):
    """One line: what is wrong, and the remedy."""


class Failed(Exception):
    """One line: why there is no mesh of good input."""


@dataclass
class LabelVolume:
    """A label image; `values[n]` is the file's value of the material n in `materials`, and 0 is background."""

    materials: "numpy.ndarray"  # noqa: F821
    values: list
    spacing_mm: "numpy.ndarray"  # noqa: F821
    index_mm_to_lps: "numpy.ndarray"  # noqa: F821  (4 x 4)


@dataclass
class TetMesh:
    """Points in index mm and materials of tets."""

    points: "numpy.ndarray"  # noqa: F821
    tets: "numpy.ndarray"  # noqa: F821
    materials: "numpy.ndarray"  # noqa: F821


class Stages:
    """Seconds by stage, of this process and its children."""

    def __init__(self):
        self.seconds = {}
        self.begin = self.last = time.perf_counter()
        self.cpu_begin = cpu_seconds()

    def end(self, name):
        now = time.perf_counter()
        self.seconds[name] = self.seconds.get(name, 0) + now - self.last
        self.last = now

    def as_json(self):
        return {"total": time.perf_counter() - self.begin, "cpu": cpu_seconds() - self.cpu_begin, "stages": self.seconds}


def cpu_seconds():
    usages = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)


def peak_rss_bytes():
    return 1024 * max(resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def read_volume(path):
    import nibabel
    import numpy

    image = nibabel.load(path)
    voxels = numpy.asanyarray(image.dataobj)
    if voxels.ndim != 3:
        raise BadInput(f"'{path}' has {voxels.ndim} dimensions; give a label image of 3")
    values, materials = numpy.unique(voxels, return_inverse=True)
    if (values != numpy.round(values)).any():
        raise BadInput(f"'{path}' has fractional values; give a label image")
    values = [int(value) for value in values]
    materials = materials.reshape(voxels.shape).astype(numpy.int32)
    if 0 in values:  # background becomes the first material, also beside negative values
        zero = values.index(0)
        order = [zero] + [n for n in range(len(values)) if n != zero]
        rank = numpy.empty(len(values), numpy.int32)
        rank[order] = numpy.arange(len(values))
        values, materials = [values[n] for n in order], rank[materials]
    else:
        values, materials = [0] + values, materials + 1
    if len(values) < 2:
        raise BadInput(f"'{path}' has no labelled voxel; give a label image")
    spacing = numpy.linalg.norm(image.affine[:3, :3], axis=0)
    frame = numpy.diag([-1.0, -1, 1, 1]) @ image.affine  # NIfTI is RAS
    frame[:3, :3] /= spacing
    return LabelVolume(materials, values, spacing, frame)


def write_mesh(path, mesh, volume):
    """VTK XML with the image's own values as `label`, every tet positive."""
    import meshio
    import numpy

    points = mesh.points @ volume.index_mm_to_lps[:3, :3].T + volume.index_mm_to_lps[:3, 3]
    corners = points[mesh.tets]
    signs = numpy.linalg.det(corners[:, 1:] - corners[:, :1])
    tets = mesh.tets.copy()
    tets[signs < 0, 2:] = tets[signs < 0, :1:-1]
    used, tets = numpy.unique(tets, return_inverse=True)
    labels = numpy.array(volume.values, numpy.int64)[mesh.materials]
    meshio.write(path, meshio.Mesh(points[used], [("tetra", tets.reshape(-1, 4))], cell_data={"label": [labels]}))
    return {"vertices": len(used), "tets": len(mesh.tets)}


def require_modules(modules):
    for module, remedy in {"numpy": "python3-numpy", "scipy": "python3-scipy", "nibabel": "python3-nibabel",
                           "meshio": "python3-meshio", **modules}.items():
        if importlib.util.find_spec(module) is None:
            raise BadInput(f"the Python module {module} of {sys.executable} is absent; install {remedy}")


def require_programs(programs):
    for program, remedy in programs.items():
        if shutil.which(program) is None:
            raise BadInput(f"the program {program} is nowhere in PATH; {remedy}")


@contextlib.contextmanager
def silenced():
    """Whatever a library writes to the terminal meanwhile, also from C++, goes nowhere."""
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(1), os.dup(2)]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        yield
    finally:
        for number, copy in zip((1, 2), kept):
            os.dup2(copy, number)
            os.close(copy)
        os.close(nowhere)


def positive(text):
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"'{text}' is not above 0")
    return value


def parse(name, parameters):
    parser = argparse.ArgumentParser(description=f"Adapter of {name} for cbc3d-bench run --external {name}.json")
    parser.add_argument("--probe", action="store_true", help="ends with 0 where the mesher can run, else says why it cannot")
    for option, text in (("image", "label image, NIfTI"), ("out", "mesh, .vtu"), ("report", "JSON")):
        parser.add_argument("--" + option, help=text)
    parser.add_argument("--threads", type=int, default=1, help="default: 1")
    for option, (kind, default, text) in parameters.items():
        parser.add_argument("--" + option, type=kind, default=default, help=f"{text}; default: {default}")
    options = parser.parse_args()
    if not options.probe and not (options.image and options.out):
        parser.error("give --image and --out")
    return options


def run(name, parameters, mesh, modules=None, programs=None, check=None, versions=None):
    """The main of an adapter. `mesh(volume, options, stages)` gives a TetMesh, whose time counts; `check()` throws BadInput where
    something else is absent."""
    options = parse(name, parameters)
    report, code = {"status": "failed", "reason": ""}, EXIT_FAILED
    try:
        require_modules(modules or {})
        require_programs(programs or {})
        if check:
            check()
        if options.probe:
            sys.exit(EXIT_SUCCESS)
        report.update(work(options, mesh), versions=versions() if versions else {})
        report["status"], code = "ok", EXIT_SUCCESS
    except BadInput as error:
        report["reason"], code = str(error), EXIT_BAD_INPUT
    except (MemoryError, Exception) as error:  # whatever a tool throws is its failure
        report["status"] = "out_of_memory" if isinstance(error, MemoryError) else "failed"
        report["reason"] = f"{name}: {' '.join(str(error).split()) or type(error).__name__}"
    if report["reason"]:
        print(report["reason"], file=sys.stdout if options.probe else sys.stderr)
    if options.report:
        with open(options.report, "w", encoding="utf-8") as file:
            json.dump(report, file)
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # tools' own threads and tables need no farewell, and some crash at theirs


def work(options, mesh):
    volume = read_volume(options.image)
    stages = Stages()
    with silenced():
        made = mesh(volume, options, stages)
    seconds = stages.as_json()
    if len(made.tets) == 0:
        raise Failed("made no tetrahedron")
    return {"seconds": seconds, "peak_rss_bytes": peak_rss_bytes(), "counts": write_mesh(options.out, made, volume)}
