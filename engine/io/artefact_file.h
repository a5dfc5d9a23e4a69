// One artefact of a run in a file: written at disk speed without a copy in memory, read back only if whole. For
// checkpoints; the layout of the bytes is that of this machine and of this build.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/base/checksum.h"
#include "engine/base/fields.h"
#include "engine/base/hash.h"
#include "engine/base/types.h"
#include "engine/io/write_file.h"
#include "engine/parallel/work.h"

namespace intarsia {

// The file: a mark, `key`, `note`, their checksum; the values one after the other; their size and checksum.
// Errors (of all members): write_failed; cancelled.
class ArtefactWriter {
 public:
  // key: what the artefact was made from. note: anything to be known without reading the rest.
  ArtefactWriter(const Work& work, const std::filesystem::path& path, std::uint64_t key, const std::string& note);
  ArtefactWriter(const Work&& work, const std::filesystem::path& path, std::uint64_t key,
                 const std::string& note) = delete;  // it is asked again at every write

  void bytes(const void* from, std::size_t size);
  // The file gets its name. It is not forced to the disk: what a power cut leaves is noticed when it is read.
  void commit();

 private:
  void put(const void* from, std::size_t size);
  void flush();

  const Work& work_;
  AtomicFile file_;
  std::string small_;  // not yet written
  std::uint64_t offset_ = 0, begin_ = 0;
  Hash sum_;
};

// Errors (of all members): bad_file if the file cannot be opened, is not whole, or its checksums are wrong; cancelled.
class ArtefactReader {
 public:
  // Reads and checks what stands before the values.
  ArtefactReader(const Work& work, const std::filesystem::path& path);
  ArtefactReader(const Work&& work, const std::filesystem::path& path) = delete;
  ~ArtefactReader();
  ArtefactReader(const ArtefactReader&) = delete;
  ArtefactReader& operator=(const ArtefactReader&) = delete;

  std::uint64_t key() const { return key_; }
  const std::string& note() const { return note_; }
  void bytes(void* to, std::size_t size);
  // A count of items that take at least item_bytes each: never more than what is left of the file explains.
  std::size_t count(std::size_t item_bytes);
  // After the last value: all of them are right, and none is left over.
  void finish();

 private:
  [[noreturn]] void fail(const char* what) const;
  void get(std::uint64_t offset, void* to, std::size_t size) const;

  const Work& work_;
  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t key_ = 0;
  std::string note_;
  std::uint64_t offset_ = 0, end_ = 0;  // of the values left
  std::string small_;                   // bytes of the file from small_begin_ on
  std::uint64_t small_begin_ = 0;
  std::uint64_t expected_ = 0;
  Hash sum_;
};

template <class T>
concept Growing = requires(T& array) {
  array.push_back(typename T::value_type());
};

// Whether an array of such values can be copied as bytes and means the same: no pointers, nothing that owns memory.
template <class T>
constexpr bool is_plain() {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    return true;
  } else if constexpr (std::is_trivially_copyable_v<T> && std::is_aggregate_v<T> && !HasFieldVisit<T>) {
    bool plain = true;
    T value{};
    for_each_field(value, [&]<class F>(F&) { plain = plain && is_plain<F>(); });
    return plain;
  } else {
    return false;
  }
}

// Whether it also has no padding, whose bytes mean nothing.
template <class T>
constexpr bool is_packed() {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    return true;
  } else if constexpr (is_plain<T>()) {
    std::size_t size = 0;
    bool packed = true;
    T value{};
    for_each_field(value, [&]<class F>(F&) { size += sizeof(F), packed = packed && is_packed<F>(); });
    return packed && size == sizeof(T);
  } else {
    return false;
  }
}

// Any value: numbers, strings, arrays of any kind, and structs of such, field by field (engine/base/fields.h).
// to: an ArtefactWriter, or anything else that takes bytes(from, size).
template <class To, class T>
void write_value(To& to, const T& value) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    to.bytes(&value, sizeof value);
  } else if constexpr (std::is_same_v<T, Vec3>) {
    for (int i = 0; i < 3; ++i) write_value(to, value[i]);
  } else if constexpr (Growing<T>) {
    using Item = typename T::value_type;
    static_assert(!std::is_same_v<T, std::vector<bool>>);
    write_value(to, std::uint64_t{value.size()});
    if constexpr (is_packed<Item>() || (is_plain<Item>() && std::is_same_v<To, ArtefactWriter>))
      to.bytes(value.data(), value.size() * sizeof(Item));
    else
      for (const Item& item : value) write_value(to, item);
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    for (const auto& item : value) write_value(to, item);
  } else {
    for_each_field(value, [&](const auto& field) { write_value(to, field); });
  }
}

// Of all bits of a value, however deep.
template <class T>
std::uint64_t exact_hash(const T& value) {
  struct {
    Hash hash;
    void bytes(const void* from, std::size_t size) { hash.add(checksum(from, size)); }
  } to;
  write_value(to, value);
  return to.hash.value();
}

// Requires: as write_value had it.
template <class T>
void read_value(ArtefactReader& from, T& value) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    from.bytes(&value, sizeof value);
  } else if constexpr (std::is_same_v<T, Vec3>) {
    for (int i = 0; i < 3; ++i) read_value(from, value[i]);
  } else if constexpr (Growing<T>) {
    using Item = typename T::value_type;
    if constexpr (is_plain<Item>()) {
      value.resize(from.count(sizeof(Item)));
      from.bytes(value.data(), value.size() * sizeof(Item));
    } else {
      value.clear();
      for (std::size_t left = from.count(1); left > 0; --left) read_value(from, value.emplace_back());
    }
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    for (auto& item : value) read_value(from, item);
  } else {
    for_each_field(value, [&](auto& field) { read_value(from, field); });
  }
}

}  // namespace intarsia
