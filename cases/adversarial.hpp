// Degenerate and broken images, generated: what a mesher must get through or refuse in one line.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cbc3d::cases {

struct AdversarialImage {
  std::string_view name;       ///< also the stem of the file
  std::string_view extension;  ///< with its dot
  bool readable;               ///< a correct file with something to mesh; else to be refused as bad input
  std::function<void(const std::filesystem::path& file)> write;
  std::vector<std::string> mesh_options{};  ///< of `cbc3d mesh`, so that the work stays small
};

/// All of them; files of at most some hundred kilobytes, the same bytes every time.
std::span<const AdversarialImage> adversarial_images();

}  // namespace cbc3d::cases
