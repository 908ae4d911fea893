#include "mesher/core/itk_formats.hpp"

#include <itkMetaImageIOFactory.h>
#include <itkNiftiImageIOFactory.h>
#include <itkNrrdImageIOFactory.h>

namespace cbc3d {

// ITK registers its readers at static initialisation only where they are linked dynamically through its own
// macro; registering the three promised formats costs nothing and does not depend on that.
void register_itk_formats() {
  static const bool registered = [] {
    itk::NiftiImageIOFactory::RegisterOneFactory();
    itk::NrrdImageIOFactory::RegisterOneFactory();
    itk::MetaImageIOFactory::RegisterOneFactory();
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace cbc3d
