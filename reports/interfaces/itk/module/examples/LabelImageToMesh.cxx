// An ITK pipeline in twenty lines: two boxes of labels, their mesh, the number of cells of each label.
#include <iostream>
#include <map>

#include "itkCBC3DImageToMeshFilter.h"
#include "itkImage.h"
#include "itkImageRegionIteratorWithIndex.h"

int main() {
  using ImageType = itk::Image<unsigned char, 3>;
  auto image = ImageType::New();
  image->SetRegions(ImageType::SizeType{{24, 16, 16}});
  image->Allocate(true);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, {{{4, 4, 4}}, {{16, 8, 8}}}); !it.IsAtEnd();
       ++it)
    it.Set(it.GetIndex()[0] < 12 ? 1 : 2);

  auto filter = itk::CBC3DImageToMeshFilter<ImageType>::New();
  filter->SetInput(image);
  filter->SetOption("min-dihedral", "15");
  filter->Update();

  std::map<int, int> cells;
  for (auto it = filter->GetOutput()->GetCellData()->Begin(); it != filter->GetOutput()->GetCellData()->End();
       ++it)
    ++cells[it.Value()];
  for (const auto& [label, count] : cells) std::cout << "label " << label << ": " << count << " cells\n";
  return cells.size() == 2 && cells.count(1) == 1 && cells.count(2) == 1 ? 0 : 1;
}
