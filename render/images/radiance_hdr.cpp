// The Radiance picture format: G. Ward, "Real Pixels", Graphics Gems II (1991), and Radiance's ray/doc/filefmts.pdf.
// A pixel is three 8-bit mantissas and one exponent; we write mantissas rounded and read them without the half step
// that Radiance's own reader adds, as most other programs do.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "render/base/whole_file.h"
#include "render/images/finite_pixels.h"
#include "render/images/image_io.h"
#include "render/images/picture_limits.h"
#include "render/images/primaries.h"

namespace render {
namespace {

constexpr int kExponentBias = 128;
constexpr int kMantissaBits = 8;
constexpr std::size_t kMinRun = 4;  // shorter runs cost more than they save
// A row of the old coding may be one pixel and two runs; of the new one, a run holds 127 pixels of one plane.
constexpr std::size_t kHdrPixelsPerByte = kMaxSide / 12;

struct Rgbe {
  std::uint8_t c[4];
};

Rgbe encode(const glm::vec3& rgb) {
  const glm::vec3 v = glm::max(rgb, glm::vec3(0.0F));
  const float largest = std::max({v.x, v.y, v.z});
  if (!(largest > 1e-38F) || !std::isfinite(largest)) return {{0, 0, 0, 0}};
  int exponent = 0;
  const float mantissa = std::frexp(largest, &exponent);
  if (std::lround(std::ldexp(mantissa, kMantissaBits)) > 255) ++exponent;  // rounding up would overflow
  const auto channel = [exponent](float x) {
    return static_cast<std::uint8_t>(std::lround(std::ldexp(x, kMantissaBits - exponent)));
  };
  return {{channel(v.x), channel(v.y), channel(v.z),
           static_cast<std::uint8_t>(std::clamp(exponent + kExponentBias, 1, 255))}};
}

glm::vec3 decode(const Rgbe& p) {
  if (p.c[3] == 0) return glm::vec3(0.0F);
  const float unit = std::ldexp(1.0F, int{p.c[3]} - (kExponentBias + kMantissaBits));
  return glm::vec3(p.c[0], p.c[1], p.c[2]) * unit;
}

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  std::uint8_t byte() {
    if (at_ >= bytes_.size()) throw std::runtime_error("the file is truncated");
    return bytes_[at_++];
  }
  std::string line() {
    std::string text;
    for (char c = static_cast<char>(byte()); c != '\n'; c = static_cast<char>(byte())) text += c;
    return text;
  }
  std::size_t size() const { return bytes_.size(); }
  Rgbe pixel() {
    Rgbe p{};
    for (std::uint8_t& c : p.c) c = byte();
    return p;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

struct Header {
  glm::vec3 exposure{1.0F};            // what the stored values were multiplied by, each channel: EXPOSURE, COLORCORR
  Imf::Chromaticities chromaticities;  // PRIMARIES; without it, Rec. 709's
  int width = 0;
  int height = 0;
  bool top_down = true;
  bool left_right = true;
};

void parse_resolution(const std::string& line, std::size_t file_bytes, Header& header) {
  std::istringstream words(line);
  std::string y;
  std::string x;
  std::int64_t height = 0;
  std::int64_t width = 0;
  words >> y >> height >> x >> width;
  if (!words || (y != "-Y" && y != "+Y") || (x != "+X" && x != "-X") || width < 1 || height < 1) {
    throw std::runtime_error("found the size line \"" + line + "\", accepted is like \"-Y 512 +X 1024\"");
  }
  check_claimed_size("its picture", width, height, file_bytes, kHdrPixelsPerByte);
  header.width = static_cast<int>(width);
  header.height = static_cast<int>(height);
  header.top_down = y == "-Y";
  header.left_right = x == "+X";
}

// The numbers after `key` in a header's line. Throws std::runtime_error where there are not N finite ones.
template <std::size_t N>
std::array<float, N> numbers_after(const std::string& line, std::string_view key) {
  std::istringstream words(line.substr(key.size()));
  words.imbue(std::locale::classic());
  std::array<float, N> numbers{};
  for (float& number : numbers) words >> number;
  if (!words) {
    throw std::runtime_error(
        fmt::format("found the line \"{}\", accepted is {} and {} number{}", line, key, N, N == 1 ? "" : "s"));
  }
  return numbers;
}

void read_variable(const std::string& line, Header& header) {
  const auto is = [&line](std::string_view key) { return line.rfind(key, 0) == 0; };
  if (is("FORMAT=") && !is("FORMAT=32-bit_rle_rgbe")) {
    throw std::runtime_error("found " + line + ", accepted is 32-bit_rle_rgbe");
  }
  if (is("EXPOSURE=")) header.exposure *= numbers_after<1>(line, "EXPOSURE=")[0];
  if (is("COLORCORR=")) {
    const auto [r, g, b] = numbers_after<3>(line, "COLORCORR=");
    header.exposure *= glm::vec3(r, g, b);
  }
  if (is("PRIMARIES=")) {
    const auto xy = numbers_after<8>(line, "PRIMARIES=");
    // Some programs write eight zeros where they know none.
    if (std::ranges::all_of(xy, [](float x) { return x == 0.0F; })) return;
    header.chromaticities = Imf::Chromaticities({xy[0], xy[1]}, {xy[2], xy[3]}, {xy[4], xy[5]}, {xy[6], xy[7]});
  }
}

Header read_header(Reader& in) {
  Header header;
  if (in.line().rfind("#?", 0) != 0) throw std::runtime_error("it does not begin with #?RADIANCE");
  for (std::string line = in.line(); !line.empty(); line = in.line()) read_variable(line, header);
  for (int c = 0; c < 3; ++c) {
    if (!(header.exposure[c] > 0.0F) || !std::isfinite(header.exposure[c])) {
      throw std::runtime_error(
          fmt::format("its EXPOSURE and COLORCORR multiply to {}, accepted are positive numbers", header.exposure[c]));
    }
  }
  parse_resolution(in.line(), in.size(), header);
  return header;
}

// Each of the four bytes of a row's pixels on its own, as runs (count above 128) and literals.
void read_planes(Reader& in, std::vector<Rgbe>& row) {
  for (std::size_t channel = 0; channel < 4; ++channel) {
    for (std::size_t x = 0; x < row.size();) {
      const std::uint8_t code = in.byte();
      const std::size_t count = code > 128 ? code - 128U : code;
      if (count == 0 || count > row.size() - x) throw std::runtime_error("a run goes past the end of its row");
      const std::uint8_t repeated = code > 128 ? in.byte() : std::uint8_t{0};
      for (std::size_t i = 0; i < count; ++i) row[x++].c[channel] = code > 128 ? repeated : in.byte();
    }
  }
}

// Flat pixels, in which (1, 1, 1, n) repeats the pixel before it; several in a row are digits of a larger count.
void read_flat(Reader& in, const Rgbe& first, std::vector<Rgbe>& row) {
  int shift = 0;
  Rgbe pixel = first;
  for (std::size_t x = 0; x < row.size();) {
    if (x > 0 || shift > 0) pixel = in.pixel();
    if (pixel.c[0] == 1 && pixel.c[1] == 1 && pixel.c[2] == 1 && x > 0) {
      const std::size_t count = std::size_t{pixel.c[3]} << shift;
      if (count > row.size() - x || shift > 24) throw std::runtime_error("a run goes past the end of its row");
      std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
      x += count;
      shift += 8;
    } else {
      row[x++] = pixel;
      shift = 0;
    }
  }
}

void read_row(Reader& in, std::vector<Rgbe>& row) {
  const Rgbe first = in.pixel();
  const bool planes = row.size() >= 8 && row.size() < 32768 && first.c[0] == 2 && first.c[1] == 2 && first.c[2] < 128;
  if (!planes) return read_flat(in, first, row);
  if ((std::size_t{first.c[2]} << 8 | first.c[3]) != row.size()) {
    throw std::runtime_error("a row's length differs from the picture's width");
  }
  read_planes(in, row);
}

LinearImage decode_hdr(std::span<const std::uint8_t> bytes, const std::string& name) {
  Reader in(bytes);
  const Header header = read_header(in);
  LinearImage image;
  image.width = header.width;
  image.height = header.height;
  const auto width = static_cast<std::size_t>(header.width);
  std::vector<Rgbe> row(width);
  for (int y = 0; y < header.height; ++y) {
    read_row(in, row);
    for (const Rgbe& p : row) image.rgb.push_back(decode(p) / header.exposure);
  }
  for (auto begin = image.rgb.begin(); !header.left_right && begin != image.rgb.end();) {
    const auto end = begin + header.width;
    std::reverse(begin, end);
    begin = end;
  }
  for (std::size_t y = 0; !header.top_down && y < static_cast<std::size_t>(header.height) / 2; ++y) {
    const auto top = image.rgb.begin() + static_cast<std::ptrdiff_t>(y * width);
    std::swap_ranges(top, top + header.width, image.rgb.end() - static_cast<std::ptrdiff_t>((y + 1) * width));
  }
  replace_invalid_values(image, name);  // the quotient by a tiny EXPOSURE overflows
  to_rec709(header.chromaticities, image);
  return image;
}

void write_plane(std::span<const Rgbe> row, std::size_t channel, Bytes& out) {
  const auto run_at = [&](std::size_t x) {
    std::size_t end = x + 1;
    while (end < row.size() && end - x < 127 && row[end].c[channel] == row[x].c[channel]) ++end;
    return end - x;
  };
  for (std::size_t x = 0; x < row.size();) {
    std::size_t end = x;
    while (end < row.size() && end - x < 128 && run_at(end) < kMinRun) ++end;
    if (end > x) {
      out.push_back(static_cast<std::uint8_t>(end - x));
      for (; x < end; ++x) out.push_back(row[x].c[channel]);
    } else {
      const std::size_t run = run_at(x);
      out.insert(out.end(), {static_cast<std::uint8_t>(128 + run), row[x].c[channel]});
      x += run;
    }
  }
}

Bytes encode_hdr(const LinearImage& image) {
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(image.height) + " +X " +
                             std::to_string(image.width) + "\n";
  Bytes out(header.begin(), header.end());
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<Rgbe> row(width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
    std::transform(image.rgb.begin() + static_cast<std::ptrdiff_t>(y * width),
                   image.rgb.begin() + static_cast<std::ptrdiff_t>((y + 1) * width), row.begin(), encode);
    if (width < 8 || width > 32767) {
      for (const Rgbe& p : row) out.insert(out.end(), p.c, p.c + 4);
      continue;
    }
    out.insert(out.end(), {2, 2, static_cast<std::uint8_t>(width >> 8), static_cast<std::uint8_t>(width & 255)});
    for (std::size_t channel = 0; channel < 4; ++channel) write_plane(row, channel, out);
  }
  return out;
}

}  // namespace

LinearImage read_hdr(const std::filesystem::path& path) {
  const Bytes bytes = read_file(path);
  try {
    return decode_hdr(bytes, path.string());
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot read Radiance HDR '" + path.string() + "': " + error.what());
  }
}

void write_hdr(const std::filesystem::path& path, const LinearImage& image) {
  const auto count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.rgb.size() != count) {
    throw std::runtime_error("cannot write Radiance HDR '" + path.string() + "': " + std::to_string(image.width) +
                             " x " + std::to_string(image.height) + " pixels, but " + std::to_string(image.rgb.size()) +
                             " values");
  }
  write_file_whole(path, encode_hdr(image));
}

}  // namespace render
