// The whole text of a mesh file, read word by word or byte by byte; what fails names the file and the line.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>

namespace cbc3d {

class FileText {
 public:
  /// Throws InputError where the file cannot be opened.
  explicit FileText(const std::filesystem::path& path);

  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  /// True where the byte before this place ends a line.
  [[nodiscard]] bool ends_a_line() const { return at_ > 0 && text_[at_ - 1] == '\n'; }
  [[nodiscard]] std::size_t bytes_left() const { return text_.size() - at_; }
  /// The rest of the line without its end; empty at the end of the file.
  std::string_view line();
  /// The next word between blanks and ends of lines; empty at the end of the file.
  std::string_view word();
  /// The next word, left where it is.
  [[nodiscard]] std::string_view peek_word();

  /// The next word as a number. `what` is being read, for the message. Throws InputError.
  std::int64_t integer(const char* what) { return integer_of(word(), what); }
  double real(const char* what) { return real_of(word(), what); }
  std::int64_t integer_of(std::string_view word, const char* what) const;
  /// A finite number, whose exponent may be Fortran's ("1.5D+3").
  double real_of(std::string_view word, const char* what) const;
  /// A number of entries, each of which has so many bytes at least.
  std::size_t count(const char* what, std::size_t least_bytes) {
    return checked_count(integer(what), what, least_bytes);
  }
  [[nodiscard]] std::size_t checked_count(std::int64_t count, const char* what,
                                          std::size_t least_bytes) const;

  /// The next bytes as a number of this machine's order. Throws InputError where they end.
  template <typename T>
  T bytes(const char* what) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes_left() < sizeof(T)) fail_at_end(what);
    T value;
    std::memcpy(&value, text_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }

  /// Moves behind the next `mark` that begins a line; false where there is none.
  bool skip_past_line(std::string_view mark);

  /// Throw InputError: "cannot read 'FILE', line N: what"; of binary data "byte N".
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_at_end(const char* what) const;
  void set_binary() { binary_ = true; }

 private:
  void skip_blanks();

  std::filesystem::path path_;
  std::string text_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

}  // namespace cbc3d
