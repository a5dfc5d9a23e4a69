#include "engine/io/artefact_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/base/checksum.h"
#include "engine/io/file_error.h"
#include "engine/parallel/for_each.h"

namespace intarsia {
namespace {

constexpr char kMark[16] = {'i', 'n', 't', 'a', 'r', 's', 'i', 'a', ' ', 's', 't', 'a', 'g', 'e', ' ', '1'};
constexpr std::size_t kPiece = std::size_t{1} << 20;  // of a large array, hashed and moved by one thread
constexpr std::size_t kSmall = std::size_t{1} << 16;  // less goes through a buffer

struct Head {
  char mark[16];
  std::uint64_t key, note_bytes, sum;  // sum: of key and note
};
struct Tail {
  std::uint64_t bytes, sum;  // of the values
};

std::uint64_t head_sum(std::uint64_t key, const std::string& note) {
  Hash hash;
  hash.add(key), hash.add(checksum(note.data(), note.size()));
  return hash.value();
}

std::size_t piece_count(std::size_t size) { return (size + kPiece - 1) / kPiece; }

}  // namespace

ArtefactWriter::ArtefactWriter(const Work& work, const std::filesystem::path& path, std::uint64_t key,
                               const std::string& note)
    : work_(work), file_(path) {
  Head head{};
  std::memcpy(head.mark, kMark, sizeof kMark);
  head.key = key, head.note_bytes = note.size(), head.sum = head_sum(key, note);
  put(&head, sizeof head);
  put(note.data(), note.size());
  flush();
  begin_ = offset_;
}

void ArtefactWriter::put(const void* from, std::size_t size) { small_.append(static_cast<const char*>(from), size); }

void ArtefactWriter::flush() {
  file_.write_at(offset_, small_.data(), small_.size());
  offset_ += small_.size();
  small_.clear();
}

void ArtefactWriter::bytes(const void* from, std::size_t size) {
  if (size < kSmall) {
    sum_.add(checksum(from, size));
    put(from, size);
    if (small_.size() >= kSmall) flush();
    return;
  }
  flush();
  const char* at = static_cast<const char*>(from);
  std::vector<std::uint64_t> part(piece_count(size));
  for_each(work_, Cost::single, part.size(), [&](std::size_t p) {
    const std::size_t begin = p * kPiece, length = std::min(kPiece, size - begin);
    part[p] = checksum(at + begin, length);
    file_.write_at(offset_ + begin, at + begin, length);
  });
  work_.check();
  sum_.add(part);
  offset_ += size;
}

void ArtefactWriter::commit() {
  flush();
  const Tail tail{offset_ - begin_, sum_.value()};
  put(&tail, sizeof tail);
  flush();
  file_.commit(false);
}

ArtefactReader::ArtefactReader(const Work& work, const std::filesystem::path& path) : work_(work), path_(path) {
  file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file_ < 0) fail("cannot be opened");
  try {
    struct stat status {};
    if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode)) fail("is no file");
    const auto size = static_cast<std::uint64_t>(status.st_size);
    Head head{};
    Tail tail{};
    if (size < sizeof head + sizeof tail) fail("is cut");
    get(0, &head, sizeof head);
    if (std::memcmp(head.mark, kMark, sizeof kMark) != 0 || head.note_bytes > size - sizeof head - sizeof tail)
      fail("is no checkpoint");
    note_.resize(head.note_bytes);
    get(sizeof head, note_.data(), note_.size());
    key_ = head.key;
    if (head.sum != head_sum(key_, note_)) fail("is damaged");
    offset_ = sizeof head + note_.size();
    end_ = size - sizeof tail;
    get(end_, &tail, sizeof tail);
    if (tail.bytes != end_ - offset_) fail("is cut");
    expected_ = tail.sum;
  } catch (...) {
    ::close(file_);
    throw;
  }
}

ArtefactReader::~ArtefactReader() { ::close(file_); }

void ArtefactReader::fail(const char* what) const { throw_bad_file(path_, what, "it is made again"); }

void ArtefactReader::get(std::uint64_t offset, void* to, std::size_t size) const {
  char* at = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t got = ::pread(file_, at, size, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("cannot be read");
    offset += static_cast<std::uint64_t>(got), at += got, size -= static_cast<std::size_t>(got);
  }
}

void ArtefactReader::bytes(void* to, std::size_t size) {
  if (size > end_ - offset_) fail("is damaged");
  if (size < kSmall) {
    if (size > 0 && (offset_ < small_begin_ || offset_ + size > small_begin_ + small_.size())) {
      small_begin_ = offset_;
      small_.resize(std::min<std::uint64_t>(kSmall, end_ - offset_));
      get(small_begin_, small_.data(), small_.size());
    }
    if (size > 0) std::memcpy(to, small_.data() + (offset_ - small_begin_), size);
    sum_.add(checksum(to, size));
    offset_ += size;
    return;
  }
  char* at = static_cast<char*>(to);
  std::vector<std::uint64_t> part(piece_count(size));
  for_each(work_, Cost::single, part.size(), [&](std::size_t p) {
    const std::size_t begin = p * kPiece, length = std::min(kPiece, size - begin);
    get(offset_ + begin, at + begin, length);
    part[p] = checksum(at + begin, length);
  });
  work_.check();
  sum_.add(part);
  offset_ += size;
}

std::size_t ArtefactReader::count(std::size_t item_bytes) {
  std::uint64_t items = 0;
  bytes(&items, sizeof items);
  if (items > (end_ - offset_) / item_bytes) fail("is damaged");
  return static_cast<std::size_t>(items);
}

void ArtefactReader::finish() {
  if (offset_ != end_ || sum_.value() != expected_) fail("is damaged");
}

}  // namespace intarsia
