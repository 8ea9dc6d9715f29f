// The tables of scene keys, key by key: a new key is tested by being listed.

#include "app/scene_file/scene_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>

#include "app/scene_file/key_documents.h"
#include "ar/error.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in.good()) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

// A folder for scene files with the models of the examples and a tag map where the examples look for them.
class SceneKeys : public testing::Test {
 protected:
  SceneKeys() {
    fs::create_directories(folder_ / "scenes");
    fs::create_directory_symlink(fs::path(SKYSHAFT_SOURCE_DIR) / "data/models", folder_ / "models");
    std::ofstream(folder_ / "scenes/tags.yaml") << tag_map_file_keys().shape().example;
  }
  ~SceneKeys() override { fs::remove_all(folder_); }

  SceneFile load(const std::string& yaml) {
    const fs::path file = folder_ / "scenes/scene.yaml";
    std::ofstream(file) << yaml << '\n';
    return load_scene_file(file);
  }

  std::string refusal(const std::string& yaml) {
    try {
      load(yaml);
    } catch (const ar::InputError& error) {
      return error.what();
    }
    return "accepted: " + yaml;
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("skyshaft_scene_keys_" + std::to_string(getpid()));
};

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void set(const MapShape& map, const KeyShape& key, const YAML::Node& value, YAML::Node& node) {
  if (contains(map.exactly_one_of, key.name)) {
    for (const std::string& other : map.exactly_one_of) node.remove(other);
  }
  node[key.name] = value;
}

// The map's example with that value at the key, and with the company that the key needs.
YAML::Node example_with(const MapShape& map, const KeyShape& key, const YAML::Node& value) {
  YAML::Node node = YAML::Load(map.example);
  const auto company_is_there = [&](const KeyShape& of) {
    if (of.only_with.empty()) return true;
    return std::any_of(of.only_with.begin(), of.only_with.end(),
                       [&](const std::string& name) { return node[name].IsDefined(); });
  };
  set(map, key, value, node);
  if (!company_is_there(key)) {
    const KeyShape& other = map.key(key.only_with.back());
    set(map, other, YAML::Load(other.example), node);
  }
  for (const KeyShape& other : map.keys) {
    if (!company_is_there(other)) node.remove(other.name);
  }
  return node;
}

using Wrap = std::function<YAML::Node(const YAML::Node&)>;
// Of a key: its path as messages say it, its shape, and a whole scene file around a value of it.
using Visit = std::function<void(const std::string&, const KeyShape&, const Wrap&)>;

void for_each_key(const MapShape& map, const std::string& path, const Wrap& whole, const Visit& visit) {
  for (const KeyShape& key : map.keys) {
    const Wrap scene = [&](const YAML::Node& value) { return whole(example_with(map, key, value)); };
    visit(path + key.name, key, scene);
    if (key.value.kind == ValueKind::Map) for_each_key(*key.value.map, path + key.name + ".", scene, visit);
    if (key.value.kind == ValueKind::List) {
      const Wrap in_list = [&](const YAML::Node& entry) {
        YAML::Node list;
        list.push_back(entry);
        return scene(list);
      };
      for_each_key(*key.value.map, path + key.name + "[0].", in_list, visit);
    }
  }
}

void for_each_key(const Visit& visit) {
  for_each_key(
      scene_keys().shape(), "", [](const YAML::Node& root) { return root; }, visit);
}

std::string written(const YAML::Node& scene) {
  std::ostringstream out;
  out << scene;
  return out.str();
}

TEST_F(SceneKeys, EveryKeysExampleIsAccepted) {
  int keys = 0;
  for_each_key([&](const std::string& path, const KeyShape& key, const Wrap& scene) {
    ++keys;
    EXPECT_FALSE(key.meaning.empty()) << path;
    const YAML::Node example = YAML::Load(key.example);
    const YAML::Node value = key.value.kind == ValueKind::List ? YAML::Load("[" + key.example + "]") : example;
    EXPECT_NO_THROW(load(written(scene(value)))) << path << "\n" << written(scene(value));
  });
  EXPECT_GT(keys, 60);
}

TEST_F(SceneKeys, NumbersOutsideTheRangeAreRefusedWithTheAcceptedOnes) {
  const auto expect_refused = [&](const std::string& path, const KeyShape& key, const Wrap& scene, double value) {
    EXPECT_THAT(refusal(written(scene(YAML::Node(value)))),
                testing::AllOf(HasSubstr("scene.yaml:"), HasSubstr(": " + path + ": found '"),
                               HasSubstr("accepted: " + accepted(key.value))))
        << path << " = " << value;
  };
  int bounds = 0;
  for_each_key([&](const std::string& path, const KeyShape& key, const Wrap& scene) {
    if (key.value.kind != ValueKind::Number && key.value.kind != ValueKind::Integer) return;
    const Range& range = key.value.range;
    if (range.least) expect_refused(path, key, scene, range.least_excluded ? *range.least : *range.least - 1.0);
    if (range.most) expect_refused(path, key, scene, range.most_excluded ? *range.most : *range.most + 1.0);
    bounds += (range.least ? 1 : 0) + (range.most ? 1 : 0);
    if (key.value.kind == ValueKind::Integer) expect_refused(path, key, scene, *range.least + 0.5);
  });
  EXPECT_GT(bounds, 30);
}

TEST_F(SceneKeys, WhatIsOfAnotherKindIsRefusedAtItsPlace) {
  for_each_key([&](const std::string& path, const KeyShape& key, const Wrap& scene) {
    const YAML::Node wrong = YAML::Load(key.value.kind == ValueKind::Map ? "[1, 2]" : "{ wrong: kind }");
    EXPECT_THAT(refusal(written(scene(wrong))),
                testing::AllOf(HasSubstr("scene.yaml:"), HasSubstr(": " + path + ": found ")))
        << path;
  });
}

TEST_F(SceneKeys, UnknownKeysAreRefusedInEveryMapWithTheKnownOnes) {
  for_each_key([&](const std::string& path, const KeyShape& key, const Wrap& scene) {
    if (key.value.kind != ValueKind::Map) return;
    YAML::Node map = YAML::Load(key.value.map->example);
    map["nonsense"] = 1;
    const std::string message = refusal(written(scene(map)));
    EXPECT_THAT(message, HasSubstr(": " + path + ": found the unknown key 'nonsense'; accepted: "));
    for (const std::string& name : key.value.map->names()) EXPECT_THAT(message, HasSubstr(name)) << path;
  });
}

TEST_F(SceneKeys, RequiredKeysAreAskedForByName) {
  const auto check = [&](const MapShape& map, const std::string& path, const Wrap& scene) {
    for (const KeyShape& key : map.keys) {
      if (!key.required) continue;
      YAML::Node node = YAML::Load(map.example);
      node.remove(key.name);
      const YAML::Node whole = scene(node);
      EXPECT_THAT(refusal(whole.size() == 0 ? "{}" : written(whole)), HasSubstr("'" + key.name + "'")) << path;
    }
  };
  check(scene_keys().shape(), "", [](const YAML::Node& root) { return root; });
  for_each_key([&](const std::string& path, const KeyShape& key, const Wrap& scene) {
    if (key.value.kind == ValueKind::Map) check(*key.value.map, path, scene);
  });
}

TEST_F(SceneKeys, DefaultsAreWhatAFileWithoutTheKeysGives) {
  const SceneFile scene = load("skyshaft: 1\nmedium: { visibility: 30 }\n");
  const MapShape& medium = medium_keys().shape();
  EXPECT_EQ(medium.key("albedo").default_text, default_text_of(scene.medium->albedo));
  EXPECT_EQ(medium.key("phase").default_text, "hg");
  EXPECT_EQ(sky_keys().shape().key("model").default_text, scene.sky.options.model);
  EXPECT_EQ(sky_keys().shape().key("turbidity").default_text, default_text_of(scene.sky.options.turbidity));
  EXPECT_EQ(quality_keys().shape().key("shadow_map_size").default_text, std::to_string(scene.quality.shadow_map_size));
  EXPECT_EQ(view_keys().shape().key("up").default_text, "[0, 0, 1]");
}

TEST_F(SceneKeys, CombinationsThatMeanNothingAreRefused) {
  const auto expect = [&](const std::string& yaml, const std::string& said) {
    EXPECT_THAT(refusal("skyshaft: 1\n" + yaml), HasSubstr(said)) << yaml;
  };
  expect("medium: { albedo: 1 }",
         "medium: found none of these keys; accepted: exactly one of visibility or extinction");
  expect("medium: { visibility: 9, extinction: 1 }", "medium: found 'visibility' and 'extinction' together");
  expect("medium: { visibility: 9, visibility: 8 }", "medium.visibility: found the key a second time, first in line 2");
  expect("medium: { visibility: 9, extent: { box: [[0, 0, 0], [1, 1, 0]] } }",
         "medium.extent.box: found a first corner");
  expect("sun: { azimuth_deg: 10 }",
         "sun: found no 'elevation_deg' beside 'azimuth_deg'; accepted: elevation_deg: degr");
  expect("sun: { color: [0, 0, 0] }", "sun.color: found a list of 3; accepted: [red, green, blue]");
  expect("sun: { color: [1, -1, 0] }", "sun.color[1]: found '-1'");
  expect("real: [ { box: { size: [1, 1, 1] }, scale: 2 } ]", "real[0].scale: found 'scale' without model");
  expect("real: [ { plane: ground, box: { size: [1, 1, 1] } } ]", "real[0]: found 'plane' and 'box' together");
  expect("tags: { family: tag36h11, file: tags.yaml }",
         "tags.family: found 'family' without map; accepted: family beside map only");
  expect("tags: { map: [ { id: 0, position: [0, 0, 0], flat: { top_edge_heading_deg: 0 } } ] }",
         "tags.map[0]: found no size here nor for all tags");
  expect(
      "tags: { size: 1, family: tag16h5, map: [ { id: 30, position: [0, 0, 0], flat: { top_edge_heading_deg: 0 } } ] }",
      "tags.map[0].id: found '30'; accepted: a whole number from 0 to 29");
  expect("tags: { size: 1, map: [] }", "tags.map: found an empty list; accepted: at least one tag");
  expect("tags: { size: 1, map: [ { id: 0, position: [0, 0, 0], orientation: [1, 1, 0, 0] } ] }",
         "tags.map[0].orientation: found a quaternion of length 1.4142");
  expect("view: { eye: [0, 0, 0], target: [0, 0, 0], vertical_fov_deg: 40 }", "view.target: found the eye's own place");
  expect("view: { eye: [0, 0, 0], target: [0, 0, 2], vertical_fov_deg: 40 }", "view.target: found a view along `up`");
  expect("sky: pereze", "sky: found 'pereze'; accepted: perez, ");
  expect("sky: pereze", "did you mean 'perez'?");
  expect("mediun: { visibility: 9 }", "did you mean 'medium'?");
  expect("lights: [ { spot: 1 } ]", "'lights' is not supported yet by this version");
  expect("objects: [ { model: nowhere.glb } ]", "where there is no file; accepted: a .glb or .gltf file");
}

TEST_F(SceneKeys, ABareWordForTheSkyIsItsModel) {
  const SceneFile bare = load("skyshaft: 1\nsky: none");
  EXPECT_EQ(bare.sky.options.model, "none");
  EXPECT_THAT(bare.sky.where, testing::EndsWith("scene.yaml:2: sky"));
  EXPECT_THAT(load("skyshaft: 1\nsky: { model: cie:3 }").sky.where, testing::EndsWith("scene.yaml:2: sky.model"));
  EXPECT_THAT(load("skyshaft: 1\nsky: { turbidity: 3 }").sky.where, testing::EndsWith("scene.yaml:2: sky"));
  EXPECT_THAT(load("skyshaft: 1\nsky: { model: 'image:a.exr' }").sky.options.model, testing::EndsWith("scenes/a.exr"));
}

TEST(SceneDocuments, KeyReferenceIsWhatTheTablesGive) {
  const std::string document = text_of(SKYSHAFT_SOURCE_DIR "/docs/scene-file.md");
  EXPECT_EQ(document, with_key_reference(document))
      << "write it anew: cmake --build BUILD -t skyshaft-write-scene-docs";
}

TEST(SceneDocuments, SchemaIsWhatTheTablesGive) {
  EXPECT_EQ(text_of(SKYSHAFT_SOURCE_DIR "/data/scene.schema.json"), scene_schema())
      << "write it anew: cmake --build BUILD -t skyshaft-write-scene-docs";
}

TEST_F(SceneKeys, YamlBlocksOfTheDocumentLoad) {
  std::istringstream document(text_of(SKYSHAFT_SOURCE_DIR "/docs/scene-file.md"));
  int blocks = 0;
  std::string block;
  bool inside = false;
  for (std::string line; std::getline(document, line);) {
    if (inside && line == "```") {
      ++blocks;
      if (block.find("skyshaft: 1") == std::string::npos) block = "skyshaft: 1\n" + block;
      EXPECT_NO_THROW(load(block)) << block;
      inside = false;
    } else if (inside) {
      block += line + "\n";
    } else if (line == "```yaml") {
      inside = true;
      block.clear();
    }
  }
  EXPECT_GT(blocks, 8);
}

TEST(ShippedScenes, NameTheSchemaInTheirFirstLineAndLoad) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(SKYSHAFT_SOURCE_DIR "/data/scenes")) {
    if (entry.path().extension() != ".yaml") continue;
    ++scenes;
    EXPECT_THAT(text_of(entry.path()), StartsWith("# yaml-language-server: $schema=../scene.schema.json\n"));
    EXPECT_NO_THROW(load_scene_file(entry.path())) << entry.path();
  }
  EXPECT_GE(scenes, 10);
}

}  // namespace
}  // namespace app
