#include "mesher/mesh_formats/text_file.hpp"

#include "mesher/core/atomic_file.hpp"

namespace cbc3d {

TextFile::TextFile(const std::filesystem::path& path, int digits)
    : path_(path), file_(std::fopen(path.c_str(), "wb")), digits_(digits) {
  if (file_ == nullptr) {
    fail_to_write(path);
  }
}

TextFile::~TextFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void TextFile::flush() {
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_) != buffer_.size()) {
    note_failure();
  }
  buffer_.clear();
}

void TextFile::note_failure() {
  failed_ = true;
  error_ = error_ == 0 ? errno : error_;
}

void TextFile::close() {
  flush();
  if (std::fclose(file_) != 0) {
    note_failure();
  }
  file_ = nullptr;
  if (failed_) {
    fail_to_write(path_, error_);
  }
}

}  // namespace cbc3d
