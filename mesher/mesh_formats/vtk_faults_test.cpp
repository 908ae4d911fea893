#include "mesher/mesh_formats/vtk_faults.hpp"

#include <gtest/gtest.h>
#include <vtkNew.h>

namespace cbc3d {
namespace {

TEST(VtkFaults, KeepTheFirst) {
  const VtkSilence silence;
  vtkNew<VtkFaults> faults;
  char first[] = "first", second[] = "second";
  faults->Execute(nullptr, 0, nullptr);
  EXPECT_TRUE(faults->text.empty());
  faults->Execute(nullptr, 0, first);
  faults->Execute(nullptr, 0, second);
  EXPECT_EQ(faults->text, "first");
}

TEST(VtkFaults, TheWindowKeepsThatThereWasAFault) {
  vtkNew<VtkWindow> window;
  window->DisplayWarningText("of no weight");
  EXPECT_FALSE(window->faulty);
  window->DisplayGenericWarningText("Error reading binary data!");
  EXPECT_TRUE(window->faulty);
}

}  // namespace
}  // namespace cbc3d
