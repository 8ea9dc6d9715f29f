#include "render/plan/renderer.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <thread>

#include "render/composite/background.h"
#include "render/composite/composite_pass.h"
#include "render/composite/display_image.h"
#include "render/composite/merge_pass.h"
#include "render/composite/planes.h"
#include "render/composite/quick_composite.h"
#include "render/composite/still_pass.h"
#include "render/gl/label.h"
#include "render/gl/read_back.h"
#include "render/plan/pass_clock.h"
#include "render/plan/screen_region.h"
#include "render/shadow/cascades.h"

namespace render {
namespace {

const Pass* find(const Plan& plan, PassKind kind) {
  for (const Pass& pass : plan.passes) {
    if (pass.kind == kind) return &pass;
  }
  return nullptr;
}

// Objects that are not there, as deep as those that are.
class BareObjects {
 public:
  BareObjects(int width, int height)
      : added_(GL_RGBA16F, width, height, gl::Filter::Nearest, 1, "no light"),
        multiplier_(GL_RGB10_A2, width, height, gl::Filter::Nearest, 1, "all kept") {
    clear(added_, 0.0F);
    clear(multiplier_, 1.0F);
  }

  ObjectsPicture picture(ObjectsPicture real) const {
    real.added = added_.id();
    real.multiplier = multiplier_.id();
    return real;
  }

 private:
  static void clear(const gl::Texture& texture, float value) {
    const gl::Framebuffer target({&texture}, nullptr, "objects that are not there");
    target.bind();
    glDisable(GL_SCISSOR_TEST);
    const std::array<float, 4> color{value, value, value, 1.0F};
    glClearBufferfv(GL_COLOR, 0, color.data());
  }

  gl::Texture added_;
  gl::Texture multiplier_;
};

// What decides the background of a still.
struct BackgroundKey {
  std::shared_ptr<const SkyModel> sky;
  Sun sun;
  Camera camera;

  bool operator==(const BackgroundKey& o) const {
    return sky == o.sky && sun.direction_in_world == o.sun.direction_in_world &&
           sun.illuminance_rgb == o.sun.illuminance_rgb && sun.angular_radius_rad == o.sun.angular_radius_rad &&
           camera.width == o.camera.width && camera.height == o.camera.height && camera.fx == o.camera.fx &&
           camera.fy == o.camera.fy && camera.cx == o.camera.cx && camera.cy == o.camera.cy &&
           camera.lens == o.camera.lens && camera.world_from_camera == o.camera.world_from_camera;
  }
};

}  // namespace

struct Renderer::Impl {
  GpuModels models;
  SunShadow shadow;
  CascadedShadow cascaded_shadow;
  std::optional<ObjectsPass> objects_pass;
  bool anti_alias = true;
  bool quick_shadows = false;
  std::unique_ptr<ShaftTechnique> shafts_technique;
  ShaftSettings shafts_settings;
  CompositePass composite_pass;
  StillPass still_pass;
  std::optional<BackgroundKey> background;
  PassClock clock;

  // With a render scale below 1:
  MergePass merge_pass;
  std::optional<QuickComposite> quick_composite;

  std::shared_ptr<const LensMap> lens_map;  // what `lens` and `lens_view` were made from
  double lens_scale = 1.0;
  std::optional<LensLookup> lens;
  View lens_view;

  template <typename F>
  void run(const Plan& plan, PassKind kind, F&& pass) {
    const Pass* planned = find(plan, kind);
    if (planned == nullptr) return;
    const gl::DebugGroup group(planned->name);
    clock.time(planned->name, std::forward<F>(pass));
  }

  View view_for(const Camera& camera, double scale = 1.0) {
    if (!camera.lens) {
      lens.reset();
      lens_map.reset();
      return ideal_view(camera, scale);
    }
    if (lens_map != camera.lens || lens_scale != scale) {
      lens_view = ideal_view(camera, scale);
      lens.emplace(*camera.lens, lens_view);
      lens_map = camera.lens;
      lens_scale = scale;
    }
    View view = lens_view;
    look_from(camera, view);
    return view;
  }

  void prepare(const Plan& plan) {
    if (!objects_pass || anti_alias != plan.anti_alias || quick_shadows != plan.quick_shadows) {
      objects_pass.emplace(plan.anti_alias ? 4 : 1, plan.quick_shadows);
      anti_alias = plan.anti_alias;
      quick_shadows = plan.quick_shadows;
    }
    if (plan.render_scale < 1.0 && !quick_composite) {
      quick_composite.emplace(static_cast<int>(std::thread::hardware_concurrency()));
    }
    if (!shafts_technique || shafts_settings != plan.shafts) {
      shafts_technique = make_shaft_technique(plan.shafts);
      shafts_settings = plan.shafts;
    }
  }

  // Shadow, objects and shafts of the ideal picture; with the shafts' distances, or only if the composite needs them.
  CompositeLayers draw_layers(const SceneState& scene, const Plan& plan, const View& view, bool with_distance = false) {
    CompositeLayers layers;
    layers.view = &view;
    layers.lens = lens ? &*lens : nullptr;
    run(plan, PassKind::SunShadow, [&] { shadow.update(scene, view, plan.shadow_map_size, models); });
    run(plan, PassKind::Objects, [&] { layers.objects = &objects_pass->draw(scene, view, shadow, models); });
    const GLuint depth = layers.objects != nullptr ? layers.objects->depth : 0;
    std::span<const Cascade> medium;
    run(plan, PassKind::CascadedShadow, [&] { medium = cascaded_shadow.update(shadow, scene, view, depth, models); });
    run(plan, PassKind::Shafts, [&] {
      const PixelRect seen = medium_region(view, *scene.medium);
      layers.shafts = &shafts_technique->draw({.scene = scene,
                                               .view = view,
                                               .depth = depth,
                                               .shadow = shadow,
                                               .medium = medium,
                                               .region_px = {seen.x, seen.y, seen.width, seen.height},
                                               .with_distance = with_distance || lens.has_value()});
    });
    return layers;
  }

  // What is seen before a background of that luminance, with nothing but medium between.
  LinearImage before(const CompositeLayers& layers, float luminance, const SceneState& scene) {
    LinearImage plain{layers.view->width, layers.view->height, {}};
    plain.rgb.assign(static_cast<std::size_t>(plain.width) * static_cast<std::size_t>(plain.height),
                     glm::vec3(luminance));
    still_pass.set_background(plain);
    background.reset();
    still_pass.draw(layers, scene.exposure);
    return still_pass.read();
  }

  // Layers smaller than the picture: merged by the GL, laid over the picture by the CPU.
  void composite_small(const SceneState& scene, const Plan& plan, const CompositeLayers& layers, const PictureView& in,
                       const MutablePictureView& out) {
    const View& view = *layers.view;
    PixelRect ideal;
    if (layers.objects != nullptr) ideal = layers.objects->touched;
    if (layers.shafts != nullptr) ideal = united(ideal, medium_region(view, *scene.medium));
    if (ideal.empty()) return copy_picture(in, out);
    const MergedPicture* merged = nullptr;
    run(plan, PassKind::Upload, [&] { merge_pass.draw(layers, ideal, in.format.matrix == ColorMatrix::Bt2020); });
    run(plan, PassKind::Read, [&] { merged = &merge_pass.read(); });
    run(plan, PassKind::Composite, [&] { quick_composite->draw(scene.camera, view, *merged, in, out); });
  }

  // The part of the real picture that the layers change.
  PixelRect changed_region(const SceneState& scene, const CompositeLayers& layers) const {
    PixelRect ideal;
    if (layers.objects != nullptr) ideal = layers.objects->touched;
    if (layers.shafts != nullptr) ideal = united(ideal, medium_region(*layers.view, *scene.medium));
    return layers.lens != nullptr ? layers.lens->real_from_ideal(ideal) : ideal;
  }
};

Renderer::Renderer(gl::Context& context) {
  context.make_current();
  impl_ = std::make_unique<Impl>();
}

Renderer::~Renderer() = default;

void Renderer::composite(const SceneState& scene, const Plan& plan, const PictureView& in,
                         const MutablePictureView& out) {
  Impl& impl = *impl_;
  impl.clock.begin_frame();
  if (in.format != out.format) throw std::logic_error("composite: the pictures' formats differ");
  if (!plan.has(PassKind::Composite)) return copy_picture(in, out);
  if (in.format.width != scene.camera.width || in.format.height != scene.camera.height) {
    throw std::runtime_error(fmt::format("the picture is {} x {} pixels, the camera's is {} x {}", in.format.width,
                                         in.format.height, scene.camera.width, scene.camera.height));
  }
  impl.prepare(plan);
  const View view = impl.view_for(scene.camera, plan.render_scale);
  const CompositeLayers layers = impl.draw_layers(scene, plan, view);
  if (plan.render_scale < 1.0) {
    impl.composite_small(scene, plan, layers, in, out);
    return impl.models.forget_unused();
  }
  const PixelRect region = CompositePass::region(in.format, impl.changed_region(scene, layers));
  if (region.empty()) return copy_picture(in, out);
  impl.run(plan, PassKind::Upload, [&] { impl.composite_pass.upload(in, region); });
  impl.run(plan, PassKind::Composite, [&] { impl.composite_pass.draw(layers, region); });
  impl.run(plan, PassKind::Read, [&] { impl.composite_pass.read(in, out, region); });
  impl.models.forget_unused();
}

LinearImage Renderer::render_linear(const SceneState& scene, const Plan& plan) {
  Impl& impl = *impl_;
  impl.clock.begin_frame();
  impl.prepare(plan);
  const View view = impl.view_for(scene.camera);
  const BackgroundKey key{scene.sky, sun_of(scene), scene.camera};
  if (impl.background != key) {
    impl.clock.time("background", [&] { impl.still_pass.set_background(sky_background(scene)); });
    impl.background = key;
  }
  const CompositeLayers layers = impl.draw_layers(scene, plan, view);
  impl.clock.time("composite", [&] { impl.still_pass.draw(layers, scene.exposure); });
  LinearImage image;
  impl.clock.time("read", [&] { image = impl.still_pass.read(); });
  impl.models.forget_unused();
  return image;
}

MediumImage Renderer::render_medium(const SceneState& scene, const Plan& plan) {
  Impl& impl = *impl_;
  if (!plan.has(PassKind::Shafts)) throw std::logic_error("render_medium: the plan has no shafts");
  impl.clock.begin_frame();
  impl.prepare(plan);
  const View view = impl.view_for(scene.camera);
  CompositeLayers layers = impl.draw_layers(scene, plan, view, true);
  ObjectsPicture bare;
  std::optional<BareObjects> nothing;
  if (layers.objects != nullptr) {
    nothing.emplace(view.width, view.height);
    bare = nothing->picture(*layers.objects);
    layers.objects = &bare;
  }
  const LinearImage light = impl.before(layers, 0.0F, scene);
  const auto white =
      static_cast<float>(1.0 / scene.exposure);  // as bright as the light, so that nothing is rounded off
  const LinearImage through = impl.before(layers, white, scene);
  MediumImage medium{.width = light.width, .height = light.height, .rgba = {}, .axis_distance_m = {}};
  for (std::size_t i = 0; i < light.rgb.size(); ++i) {
    const glm::vec3 kept = (through.rgb[i] - light.rgb[i]) / white;
    medium.rgba.emplace_back(light.rgb[i], kept.g);
  }
  if (layers.shafts->width == medium.width && layers.shafts->height == medium.height) {
    medium.axis_distance_m = gl::read_red(layers.shafts->distance, medium.width, medium.height);
  }
  impl.models.forget_unused();
  return medium;
}

std::optional<ShaftError> Renderer::shafts_error() const {
  return impl_->shafts_technique ? impl_->shafts_technique->error() : std::nullopt;
}

LinearImage MediumImage::in_scattered() const {
  return {width, height, std::vector<glm::vec3>(rgba.begin(), rgba.end())};
}

LinearImage MediumImage::transmittance() const {
  LinearImage image{width, height, {}};
  for (const glm::vec4& pixel : rgba) image.rgb.emplace_back(pixel.a);
  return image;
}

Image Renderer::display_image(const LinearImage& linear, double exposure) const {
  return render::display_image(linear, exposure);
}

void Renderer::enable_timing(bool on) {
  impl_->clock.enable(on);
}
const std::vector<PassTime>& Renderer::pass_times() const {
  return impl_->clock.times();
}

}  // namespace render
