"""Frames of images: nibabel's affine as spacing, origin and direction."""
import numpy as _np


def frame_of_affine(affine):
    """The spacing (mm), origin (mm, LPS) and direction (3 x 3, LPS) of an affine as nibabel has it.

    The affine maps i, j, k to right-anterior-superior mm; what comes back is left-posterior-superior, as mesh() takes it:

        image = nibabel.load("labels.nii.gz")
        spacing, origin, direction = cbc3d.frame_of_affine(image.affine)
        mesh = cbc3d.mesh(numpy.asarray(image.dataobj), spacing, origin, direction, axes="ijk")
    """
    affine = _np.asarray(affine, dtype=float)
    if affine.shape != (4, 4) or not _np.all(_np.isfinite(affine)):
        raise ValueError("affine: give 4 x 4 finite numbers")
    ras_to_lps = _np.diag([-1.0, -1.0, 1.0])
    columns = ras_to_lps @ affine[:3, :3]
    spacing = _np.linalg.norm(columns, axis=0)
    if not _np.all(spacing > 0):
        raise ValueError("affine: an axis has no length")
    return tuple(spacing), tuple(ras_to_lps @ affine[:3, 3]), columns / spacing
