#include "mesher/core/itk_formats.hpp"

#include <gtest/gtest.h>
#include <itkImageIOFactory.h>

#include <string>

namespace cbc3d {
namespace {

std::string writer_of(const char* file) {
  const auto found = itk::ImageIOFactory::CreateImageIO(file, itk::CommonEnums::IOFileMode::WriteMode);
  return found.IsNull() ? "none" : found->GetNameOfClass();
}

TEST(ItkFormats, ThreeAreKnownHoweverOftenTheyAreRegistered) {
  register_itk_formats();
  const auto before = itk::ObjectFactoryBase::GetRegisteredFactories().size();
  register_itk_formats();
  EXPECT_EQ(itk::ObjectFactoryBase::GetRegisteredFactories().size(), before);
  EXPECT_EQ(writer_of("image.nii.gz"), "NiftiImageIO");
  EXPECT_EQ(writer_of("image.nrrd"), "NrrdImageIO");
  EXPECT_EQ(writer_of("image.mha"), "MetaImageIO");
}

}  // namespace
}  // namespace cbc3d
