#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/scene_file/value_shape.h"

namespace app {

// A key of a map, as messages, documents and the schema describe it.
struct KeyShape {
  std::string name;
  ValueShape value;
  std::string meaning;  // a sentence or two, Markdown
  std::string example;  // the value as YAML; the tests load it
  bool required = false;
  std::string default_text;            // what holds without the key; empty: nothing to say
  std::vector<std::string> only_with;  // one of these has to be there too
};

struct MapShape {
  std::vector<KeyShape> keys;
  std::vector<std::string> exactly_one_of;  // keys of which one, and no more, is there; empty: no such rule
  std::vector<std::string> not_yet;  // keys that belong to the format but do nothing: an empty list may stand there
  std::string bare_key;              // a bare scalar in place of the map is the value of this key; or empty
  std::string example;               // of the whole map, YAML; the tests load it

  std::vector<std::string> names() const;
  const KeyShape& key(const std::string& name) const;  // one that is there
};

// The entries of a map after all that its shape says of its keys was checked. Throws ar::InputError.
YamlMap checked_map(const YamlValue& value, const MapShape& shape);

// What a person is told of a key.
struct KeyText {
  std::string meaning;
  std::string example;
};

std::string default_text_of(double value);
std::string default_text_of(const glm::dvec3& value);
std::string default_text_of(bool value);

namespace detail {

template <typename T>
struct Unwrapped {
  using Type = T;
};
template <typename T>
struct Unwrapped<std::optional<T>> {
  using Type = T;
};

}  // namespace detail

// The keys of one kind of map in a YAML file and where each goes in `Target`. One row says all there is to a key; the
// default is what a fresh Target holds, or nothing where that is an empty std::optional. `access` is a pointer to the
// member or a function from Target& to a reference.
template <typename Target>
class KeyTable {
 public:
  using Read = std::function<void(const YamlValue&, Target&)>;
  using Finish = std::function<void(const YamlMap&, Target&)>;

  const MapShape& shape() const { return shape_; }

  void read(const YamlValue& value, Target& target) const {
    if (!shape_.bare_key.empty() && value.is_scalar()) return read_of(shape_.bare_key)(value, target);
    const YamlMap map = checked_map(value, shape_);
    for (std::size_t i = 0; i < reads_.size(); ++i) {
      if (const auto entry = map.find(shape_.keys[i].name)) reads_[i](*entry, target);
    }
    if (finish_) finish_(map, target);
  }

  // A row that `read` reads by itself, by shape.value's words.
  KeyTable& add(const std::string& name, ValueShape shape, Read read, KeyText text) {
    shape_.keys.push_back({.name = name,
                           .value = std::move(shape),
                           .meaning = std::move(text.meaning),
                           .example = std::move(text.example),
                           .default_text = "",
                           .only_with = {}});
    reads_.push_back(std::move(read));
    return *this;
  }

  // A number that is kept as `per_unit` times what is written, an angle in radians say.
  template <typename Access>
  KeyTable& number(const std::string& name, const ValueShape& shape, Access access, KeyText text,
                   double per_unit = 1.0) {
    add(
        name, shape,
        [=](const YamlValue& value, Target& target) {
          std::invoke(access, target) = read_number(value, shape) * per_unit;
        },
        std::move(text));
    return default_from(access, [=](double value) { return default_text_of(value / per_unit); });
  }

  template <typename Access>
  KeyTable& integer(const std::string& name, const ValueShape& shape, Access access, KeyText text) {
    const int least = static_cast<int>(*shape.range.least);
    const int most = static_cast<int>(*shape.range.most);
    add(
        name, shape,
        [=](const YamlValue& value, Target& target) {
          auto& member = std::invoke(access, target);
          member = static_cast<std::decay_t<decltype(member)>>(value.integer(least, most));
        },
        std::move(text));
    return default_from(access, [](auto value) { return default_text_of(static_cast<double>(value)); });
  }

  template <typename Access>
  KeyTable& flag(const std::string& name, Access access, KeyText text) {
    add(
        name, shapes::boolean(),
        [=](const YamlValue& value, Target& target) { std::invoke(access, target) = value.boolean(); },
        std::move(text));
    return default_from(access, [](bool value) { return default_text_of(value); });
  }

  // Three numbers.
  template <typename Access>
  KeyTable& vector(const std::string& name, const ValueShape& shape, Access access, KeyText text) {
    add(
        name, shape,
        [=](const YamlValue& value, Target& target) { std::invoke(access, target) = read_vector(value, shape); },
        std::move(text));
    return default_from(access, [](const glm::dvec3& value) { return default_text_of(value); });
  }

  // One of several words, each with the value that it stands for.
  template <typename Access, typename Value>
  KeyTable& word(const std::string& name, const std::vector<std::pair<std::string, Value>>& meanings, Access access,
                 KeyText text) {
    std::vector<std::string> words;
    for (const auto& [word, value] : meanings) words.push_back(word);
    add(
        name, shapes::one_word_of(words),
        [=](const YamlValue& found, Target& target) {
          const std::string chosen = found.one_of(words);
          for (const auto& [word, value] : meanings) {
            if (word == chosen) std::invoke(access, target) = value;
          }
        },
        std::move(text));
    return default_from(access, [=](const Value& standard) {
      for (const auto& [word, value] : meanings) {
        if (value == standard) return word;
      }
      return std::string();
    });
  }

  // A map with a table of its own.
  template <typename Part, typename Access>
  KeyTable& map(const std::string& name, const KeyTable<Part>& table, Access access, KeyText text) {
    return add(
        name, shapes::map_of(table.shape()),
        [&table, access](const YamlValue& value, Target& target) {
          Part part{};
          table.read(value, part);
          std::invoke(access, target) = std::move(part);
        },
        std::move(text));
  }

  // A list of maps with a table of their own, appended to what `access` leads to.
  template <typename Entry, typename Access>
  KeyTable& list(const std::string& name, const KeyTable<Entry>& table, Access access, KeyText text) {
    return add(
        name, shapes::list_of(table.shape()),
        [&table, access](const YamlValue& value, Target& target) {
          for (const YamlValue& item : value.list()) {
            Entry entry{};
            table.read(item, entry);
            std::invoke(access, target).push_back(std::move(entry));
          }
        },
        std::move(text));
  }

  // Of the row before.
  KeyTable& required() {
    last().required = true;
    last().default_text.clear();
    return *this;
  }
  KeyTable& only_with(std::vector<std::string> others) {
    last().only_with = std::move(others);
    return *this;
  }
  KeyTable& or_else(std::string what_holds_without) {
    last().default_text = std::move(what_holds_without);
    return *this;
  }

  // Of the map.
  KeyTable& exactly_one_of(std::vector<std::string> choices) {
    shape_.exactly_one_of = std::move(choices);
    return *this;
  }
  KeyTable& not_yet(std::vector<std::string> names) {
    shape_.not_yet = std::move(names);
    return *this;
  }
  KeyTable& bare(std::string key) {
    shape_.bare_key = std::move(key);
    return *this;
  }
  KeyTable& example(std::string yaml) {
    shape_.example = std::move(yaml);
    return *this;
  }
  // Runs after the rows: what has to hold between keys.
  KeyTable& finish(Finish finish) {
    finish_ = std::move(finish);
    return *this;
  }

 private:
  KeyShape& last() { return shape_.keys.back(); }

  const Read& read_of(const std::string& name) const {
    for (std::size_t i = 0; i < reads_.size(); ++i) {
      if (shape_.keys[i].name == name) return reads_[i];
    }
    throw std::logic_error("no row for the bare key " + name);
  }

  template <typename Access, typename InWords>
  KeyTable& default_from(Access access, const InWords& in_words) {
    Target fresh{};
    const auto& member = std::invoke(access, fresh);
    using Member = std::decay_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, typename detail::Unwrapped<Member>::Type>) {
      last().default_text = in_words(member);
    } else if (member) {
      last().default_text = in_words(*member);
    }
    return *this;
  }

  MapShape shape_;
  std::vector<Read> reads_;
  Finish finish_;
};

}  // namespace app
