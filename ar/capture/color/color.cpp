#include "ar/capture/color/color.h"

#include <algorithm>

namespace ar {
namespace {

ColorMatrix matrix_of(int code) {
  switch (code) {
    case 0:
      return ColorMatrix::Rgb;
    case 1:
      return ColorMatrix::Bt709;
    case 4:  // FCC, within 1/255 of BT.601
    case 5:
    case 6:
      return ColorMatrix::Bt601;
    case 9:
      return ColorMatrix::Bt2020;
    default:
      return ColorMatrix::Unknown;
  }
}

Transfer transfer_of(int code) {
  switch (code) {
    case 1:
    case 6:
    case 7:
    case 11:  // xvYCC and BT.1361 are BT.709 within [0, 1]
    case 12:
    case 14:
    case 15:
      return Transfer::Bt709;
    case 4:
      return Transfer::Gamma22;
    case 5:
      return Transfer::Gamma28;
    case 8:
      return Transfer::Linear;
    case 13:
      return Transfer::Srgb;
    case 16:
      return Transfer::Pq;
    case 18:
      return Transfer::Hlg;
    default:
      return Transfer::Unknown;
  }
}

Primaries primaries_of(int code) {
  switch (code) {
    case 1:
      return Primaries::Bt709;
    case 5:
      return Primaries::Bt601_625;
    case 6:
    case 7:
      return Primaries::Bt601_525;
    case 9:
      return Primaries::Bt2020;
    case 12:
      return Primaries::DisplayP3;
    default:
      return Primaries::Unknown;
  }
}

bool high_definition(int width, int height) {
  return std::max(width, height) >= 1280 || std::min(width, height) > 576;
}

bool is_jfif(const ColorInfo& color) {
  return color.matrix == ColorMatrix::Bt601 && color.range == ColorRange::Full &&
         color.primaries == Primaries::Unknown && color.transfer == Transfer::Unknown;
}

ColorMatrix guess_matrix(const ColorInfo& color, int width, int height) {
  if (color.primaries == Primaries::Bt2020) return ColorMatrix::Bt2020;
  if (color.primaries == Primaries::Bt709) return ColorMatrix::Bt709;
  return high_definition(width, height) ? ColorMatrix::Bt709 : ColorMatrix::Bt601;
}

Primaries guess_primaries(const ColorInfo& color, int width, int height) {
  if (color.matrix == ColorMatrix::Bt2020) return Primaries::Bt2020;
  if (color.matrix != ColorMatrix::Bt601) return Primaries::Bt709;
  const int lines = std::min(width, height);
  if (lines == 576) return Primaries::Bt601_625;
  if (lines == 480 || lines == 486) return Primaries::Bt601_525;
  return Primaries::Bt709;
}

const char* name(ColorMatrix matrix) {
  switch (matrix) {
    case ColorMatrix::Rgb:
      return "RGB";
    case ColorMatrix::Bt601:
      return "BT.601";
    case ColorMatrix::Bt709:
      return "BT.709";
    case ColorMatrix::Bt2020:
      return "BT.2020";
    case ColorMatrix::Unknown:
      break;
  }
  return "unknown";
}

const char* name(Transfer transfer) {
  switch (transfer) {
    case Transfer::Bt709:
      return "BT.709";
    case Transfer::Srgb:
      return "sRGB";
    case Transfer::Linear:
      return "linear";
    case Transfer::Gamma22:
      return "gamma 2.2";
    case Transfer::Gamma28:
      return "gamma 2.8";
    case Transfer::Pq:
      return "PQ";
    case Transfer::Hlg:
      return "HLG";
    case Transfer::Unknown:
      break;
  }
  return "unknown";
}

const char* name(Primaries primaries) {
  switch (primaries) {
    case Primaries::Bt709:
      return "BT.709";
    case Primaries::Bt601_525:
      return "BT.601 (525 lines)";
    case Primaries::Bt601_625:
      return "BT.601 (625 lines)";
    case Primaries::Bt2020:
      return "BT.2020";
    case Primaries::DisplayP3:
      return "Display P3";
    case Primaries::Unknown:
      break;
  }
  return "unknown";
}

}  // namespace

ColorInfo color_from_tags(const ColorTags& tags) {
  ColorInfo color;
  color.matrix = matrix_of(tags.matrix);
  color.transfer = transfer_of(tags.transfer);
  color.primaries = primaries_of(tags.primaries);
  if (tags.range == 1) color.range = ColorRange::Limited;
  if (tags.range == 2) color.range = ColorRange::Full;
  if (tags.siting == 1) color.siting = ChromaSiting::Left;
  if (tags.siting == 2) color.siting = ChromaSiting::Center;
  if (tags.siting == 3) color.siting = ChromaSiting::TopLeft;
  return color;
}

ColorTags tags_from_color(const ColorInfo& color) {
  constexpr int kUnspecified = 2;
  ColorTags tags;
  // Both lists follow the order of their enumerations.
  constexpr int kMatrix[] = {kUnspecified, 0, 6, 1, 9};
  constexpr int kTransfer[] = {kUnspecified, 1, 13, 8, 4, 5, 16, 18};
  constexpr int kPrimaries[] = {kUnspecified, 1, 6, 5, 9, 12};
  tags.matrix = kMatrix[static_cast<int>(color.matrix)];
  tags.transfer = kTransfer[static_cast<int>(color.transfer)];
  tags.primaries = kPrimaries[static_cast<int>(color.primaries)];
  tags.range = static_cast<int>(color.range);
  tags.siting = static_cast<int>(color.siting);
  return tags;
}

ColorInfo guess_color(const ColorInfo& color, int width, int height) {
  ColorInfo full = color;
  const bool jfif = is_jfif(color);
  if (full.matrix == ColorMatrix::Unknown) full.matrix = guess_matrix(color, width, height);
  const bool rgb = full.matrix == ColorMatrix::Rgb;
  if (full.primaries == Primaries::Unknown) {
    full.primaries = jfif ? Primaries::Bt709 : guess_primaries(full, width, height);
  }
  if (full.transfer == Transfer::Unknown) full.transfer = rgb || jfif ? Transfer::Srgb : Transfer::Bt709;
  if (full.range == ColorRange::Unknown) full.range = rgb ? ColorRange::Full : ColorRange::Limited;
  if (full.siting == ChromaSiting::Unknown) full.siting = rgb || jfif ? ChromaSiting::Center : ChromaSiting::Left;
  return full;
}

std::string describe_guess(const ColorInfo& tagged, const ColorInfo& guessed) {
  std::string text;
  const auto add = [&text](const char* field, const char* value) {
    if (!text.empty()) text += ", ";
    text += field;
    text += ' ';
    text += value;
  };
  if (tagged.matrix != guessed.matrix) add("matrix", name(guessed.matrix));
  if (tagged.range != guessed.range) add("range", guessed.range == ColorRange::Full ? "full" : "limited");
  if (tagged.transfer != guessed.transfer) add("transfer", name(guessed.transfer));
  if (tagged.primaries != guessed.primaries) add("primaries", name(guessed.primaries));
  return text;
}

}  // namespace ar
