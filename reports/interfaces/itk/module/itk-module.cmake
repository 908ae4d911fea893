# The module CBC3D of ITK: label images to meshes. It is header-only; what it calls is the library cbc3d.
itk_module(CBC3D
  DEPENDS
    ITKCommon
    ITKMesh
  TEST_DEPENDS
    ITKTestKernel
  EXCLUDE_FROM_DEFAULT
  DESCRIPTION "Meshes every label of a label image with the library cbc3d, which must be installed.")
