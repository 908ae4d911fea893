#include "mesher/formats/byte_stream.hpp"

#include <bzlib.h>

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

using testing::packed;

std::string bzipped(const std::string& bytes) {
  std::string out(bytes.size() + 700, '\0');
  auto length = static_cast<unsigned>(out.size());
  EXPECT_EQ(BZ2_bzBuffToBuffCompress(out.data(), &length, const_cast<char*>(bytes.data()),
                                     static_cast<unsigned>(bytes.size()), 9, 0, 0),
            BZ_OK);
  out.resize(length);
  return out;
}

class ByteStreams : public ::testing::Test {
 protected:
  /// All bytes of a stream; the fault where it has one.
  [[nodiscard]] std::string all(const std::string& file, Encoding encoding) const {
    folder_.write("f", file);
    std::string text(100, '\0');
    try {
      text.resize(open_stream(folder_.file("f"), 0, 0, encoding)
                      ->read({reinterpret_cast<std::uint8_t*>(text.data()), text.size()}));
    } catch (const FormatError& error) {
      return error.what();
    }
    return text;
  }
  cbc3d::testing::TemporaryFolder folder_{"streams"};
};

TEST_F(ByteStreams, GzipAndBzip2OfSeveralMembers) {
  EXPECT_EQ(all("plain", Encoding::raw), "plain");
  EXPECT_EQ(all(packed("one ") + packed("two"), Encoding::gzip), "one two");
  EXPECT_EQ(all(bzipped("one ") + bzipped("two"), Encoding::bzip2), "one two");
  EXPECT_EQ(all(packed("one") + std::string(600, '\0'), Encoding::gzip), "one");
  EXPECT_EQ(all(bzipped("one") + std::string(600, '\0'), Encoding::bzip2), "one");
}

TEST_F(ByteStreams, DamageIsNamed) {
  for (std::size_t length = 2; length < packed("some text").size(); ++length) {
    EXPECT_NE(all(packed("some text").substr(0, length), Encoding::gzip).find("break off"), std::string::npos)
        << length;
  }
  for (std::size_t length = 4; length < bzipped("some text").size(); ++length) {
    EXPECT_NE(all(bzipped("some text").substr(0, length), Encoding::bzip2).find("break off"),
              std::string::npos);
  }
  std::string crc = packed("some text");
  crc[crc.size() - 6] ^= 1;
  EXPECT_NE(all(crc, Encoding::gzip).find("damaged"), std::string::npos);
  EXPECT_NE(all(packed("a") + "b", Encoding::gzip).find("followed"), std::string::npos);
  EXPECT_NE(all(bzipped("a") + "b", Encoding::bzip2).find("damaged"), std::string::npos);
}

TEST_F(ByteStreams, FilesAreKnownByTheirFirstBytes) {
  folder_.write("z", packed("text"));
  folder_.write("b", bzipped("text"));
  folder_.write("r", "text");
  EXPECT_EQ(encoding_of_file(folder_.file("z")), Encoding::gzip);
  EXPECT_EQ(encoding_of_file(folder_.file("b")), Encoding::bzip2);
  EXPECT_EQ(encoding_of_file(folder_.file("r")), Encoding::raw);
  EXPECT_EQ(head_of_file(folder_.file("z"), Encoding::gzip, 2), "te");
  EXPECT_EQ(head_of_file(folder_.file("z"), Encoding::gzip, 20), "text");
  EXPECT_THROW(encoding_of_file(folder_.file("absent")), FormatError);
}

}  // namespace
}  // namespace cbc3d::formats
