#include "mesher/mesh_formats/text_file.hpp"

#include "mesher/core/error.hpp"

namespace cbc3d {

TextFile::TextFile(const std::filesystem::path& path, int digits)
    : path_(path), file_(std::fopen(path.c_str(), "wb")), digits_(digits) {
  if (file_ == nullptr) {
    throw JobError("cannot write '" + path.string() + "': the file cannot be created");
  }
}

TextFile::~TextFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void TextFile::flush() {
  failed_ |= std::fwrite(buffer_.data(), 1, buffer_.size(), file_) != buffer_.size();
  buffer_.clear();
}

void TextFile::close() {
  flush();
  failed_ |= std::fclose(file_) != 0;
  file_ = nullptr;
  if (failed_) {
    throw JobError("cannot write '" + path_.string() + "': the disk is full or the file cannot be written");
  }
}

}  // namespace cbc3d
