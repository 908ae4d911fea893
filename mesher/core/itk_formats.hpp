// The file formats of ITK.
#pragma once

namespace cbc3d {

/// Registers ITK's readers and writers of NIfTI, NRRD and MetaImage. A second call does nothing.
void register_itk_formats();

}  // namespace cbc3d
