#include "render/composite/encode_variant.h"

#include <stdexcept>
#include <string>

namespace render {

gl::Defines encode_defines(const PictureFormat& format) {
  // 4:2:2 has no vertical subsampling; siting along y does not matter there.
  const bool centred_x = format.siting == ChromaSiting::Center;
  const bool centred_y = format.siting != ChromaSiting::TopLeft;
  const char* chroma = format.chroma == Chroma::C420 ? "420" : format.chroma == Chroma::C422 ? "422" : "444";
  gl::Defines defines{{"BIT_DEPTH", std::to_string(format.bit_depth)},
                      {"CHROMA", chroma},
                      {"SITING_X", centred_x ? "1" : "0"},
                      {"SITING_Y", centred_y ? "1" : "0"}};
  switch (format.transfer) {
    case Transfer::Bt709:
      defines.push_back({"TRANSFER", "0"});
      break;
    case Transfer::Srgb:
      defines.push_back({"TRANSFER", "1"});
      break;
    case Transfer::Linear:
      defines.push_back({"TRANSFER", "2"});
      break;
    case Transfer::Gamma22:
    case Transfer::Gamma28:
      defines.push_back({"TRANSFER", "3"});
      defines.push_back({"GAMMA", format.transfer == Transfer::Gamma22 ? "2.2" : "2.8"});
      break;
    case Transfer::Pq:
    case Transfer::Hlg:
    case Transfer::Unknown:
      throw std::runtime_error("a picture with an HDR transfer function (PQ or HLG) cannot be composited; tone-map it");
  }
  if (format.matrix == ColorMatrix::Bt2020) defines.push_back({"WIDE_GAMUT"});
  return defines;
}

std::vector<PictureFormat> encoded_formats() {
  std::vector<PictureFormat> formats;
  for (const int bit_depth : {8, 10}) {
    for (const Chroma chroma : {Chroma::C420, Chroma::C422, Chroma::C444}) {
      formats.push_back({.bit_depth = bit_depth, .chroma = chroma});
    }
  }
  for (const ChromaSiting siting : {ChromaSiting::Center, ChromaSiting::TopLeft}) formats.push_back({.siting = siting});
  for (const Transfer transfer : {Transfer::Srgb, Transfer::Linear, Transfer::Gamma22, Transfer::Gamma28}) {
    formats.push_back({.transfer = transfer});
  }
  formats.push_back({.bit_depth = 10, .matrix = ColorMatrix::Bt2020});
  return formats;
}

}  // namespace render
