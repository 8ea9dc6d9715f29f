// Pages on paper, with cairo.

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "calib/boards/board_drawing.h"

namespace calib {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;

struct SurfaceEnd {
  void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
};
struct ContextEnd {
  void operator()(cairo_t* c) const { cairo_destroy(c); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceEnd>;
using Context = std::unique_ptr<cairo_t, ContextEnd>;

[[noreturn]] void fail(const std::string& path, const char* reason) {
  throw std::runtime_error(
      fmt::format("{}: cannot be written: {}\nis the folder there, writable, and its disk not full?", path, reason));
}

// All black in one path and one fill, so that no seam shows between neighbours.
void fill_black(cairo_t* c, const Page& page) {
  for (const cv::Rect2d& r : page.black) cairo_rectangle(c, r.x, r.y, r.width, r.height);
  for (const auto& polygon : page.tilted) {
    cairo_move_to(c, polygon[0].x, polygon[0].y);
    for (std::size_t i = 1; i < polygon.size(); ++i) cairo_line_to(c, polygon[i].x, polygon[i].y);
    cairo_close_path(c);
  }
  cairo_fill(c);
}

void text(cairo_t* c, double x, double y, const std::string& words) {
  cairo_move_to(c, x, y);
  cairo_show_text(c, words.c_str());
}

// A line of ruler_mm with a tick every millimetre, longer ones every 5 and 10.
void draw_ruler(cairo_t* c, const Page& page) {
  cairo_set_line_width(c, 0.15);
  const auto length = static_cast<int>(page.ruler_mm);
  for (int mm = 0; mm <= length; ++mm) {
    const double tick = mm % 10 == 0 ? 4.0 : mm % 5 == 0 ? 3.0 : 2.0;
    cairo_move_to(c, page.ruler_at.x + mm, page.ruler_at.y);
    cairo_line_to(c, page.ruler_at.x + mm, page.ruler_at.y + tick);
  }
  cairo_move_to(c, page.ruler_at.x, page.ruler_at.y);
  cairo_line_to(c, page.ruler_at.x + page.ruler_mm, page.ruler_at.y);
  cairo_stroke(c);
  text(c, page.ruler_at.x + page.ruler_mm + 2.0, page.ruler_at.y + 4.0, fmt::format("{} mm", length));
}

void draw(cairo_t* c, const Page& page) {
  cairo_set_source_rgb(c, 1.0, 1.0, 1.0);
  cairo_paint(c);
  cairo_set_source_rgb(c, 0.0, 0.0, 0.0);
  fill_black(c, page);
  cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, 2.8);
  // A long caption is set smaller rather than cut off by the margin.
  cairo_text_extents_t extents;
  cairo_text_extents(c, page.caption.c_str(), &extents);
  const double room = page.width_mm - 2.0 * page.caption_at.x;
  if (extents.width > room) cairo_set_font_size(c, 2.8 * room / extents.width);
  text(c, page.caption_at.x, page.caption_at.y, page.caption);
  cairo_set_font_size(c, 2.8);
  draw_ruler(c, page);
}

void check(cairo_status_t status, const std::string& path) {
  if (status != CAIRO_STATUS_SUCCESS) fail(path, cairo_status_to_string(status));
}

void write_vector(const std::string& path, const std::vector<Page>& pages, bool pdf) {
  const double width = pages[0].width_mm * kPointsPerMm;
  const double height = pages[0].height_mm * kPointsPerMm;
  const Surface surface(pdf ? cairo_pdf_surface_create(path.c_str(), width, height)
                            : cairo_svg_surface_create(path.c_str(), width, height));
  check(cairo_surface_status(surface.get()), path);
  const Context context(cairo_create(surface.get()));
  for (const Page& page : pages) {
    if (pdf) cairo_pdf_surface_set_size(surface.get(), page.width_mm * kPointsPerMm, page.height_mm * kPointsPerMm);
    cairo_save(context.get());
    cairo_scale(context.get(), kPointsPerMm, kPointsPerMm);
    draw(context.get(), page);
    cairo_restore(context.get());
    cairo_show_page(context.get());
  }
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()), path);
}

void write_png(const std::string& path, const Page& page, double dpi) {
  const double px_per_mm = dpi / 25.4;
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                   static_cast<int>(std::lround(page.width_mm * px_per_mm)),
                                                   static_cast<int>(std::lround(page.height_mm * px_per_mm))));
  check(cairo_surface_status(surface.get()), path);
  const Context context(cairo_create(surface.get()));
  cairo_scale(context.get(), px_per_mm, px_per_mm);
  draw(context.get(), page);
  check(cairo_surface_write_to_png(surface.get(), path.c_str()), path);
}

}  // namespace

void write_pages(const std::string& path, const std::vector<Page>& pages, double dpi) {
  const bool pdf = path.ends_with(".pdf");
  const bool svg = path.ends_with(".svg");
  if (!pdf && !svg && !path.ends_with(".png")) {
    throw std::runtime_error(fmt::format("{}: its ending says no format\naccepted: .pdf, .svg, .png", path));
  }
  if (!pdf && pages.size() > 1) {
    throw std::runtime_error(
        fmt::format("{}: {} pages\na layout that is not flat takes a page a tag: write a .pdf", path, pages.size()));
  }
  if (pdf || svg) {
    write_vector(path, pages, pdf);
  } else {
    write_png(path, pages[0], dpi);
  }
}

}  // namespace calib
