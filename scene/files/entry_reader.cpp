#include "scene/files/entry_reader.h"

#include <archive.h>
#include <archive_entry.h>
#include <locale.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <vector>

#include "core/text.h"
#include "scene/files/assets.h"
#include "scene/files/bundle.h"
#include "scene/messages.h"

namespace farol::scene {
namespace {

using std::string_view;

// Deflate makes 1032 bytes of one at most. Pictures and meshes stay far below this; text full of
// blanks reaches it, so that small bundles are not held to it.
constexpr std::size_t kMaxRatio = 200;
constexpr std::size_t kFreeBytes = std::size_t{4} << 20U;
constexpr std::size_t kBlock = 64 * 1024;
/// Bytes unpacked to list an archive or to reach an entry of one that has no directory.
constexpr std::size_t kMaxPassed = std::size_t{512} << 20U;
constexpr std::size_t kHeadBytes = 4096;  // of an entry of a tar file, with a long name
constexpr string_view kGzip = "\x1f\x8b";
constexpr string_view kSevenZip = "7z\xBC\xAF\x27\x1C";
constexpr string_view kRar = "Rar!\x1A\x07";

struct Closer {
    void operator()(archive* one) const { archive_read_free(one); }
};
using Reader = std::unique_ptr<archive, Closer>;

/// Sets a UTF-8 locale while it lives: libarchive decodes names by the locale.
class Utf8Locale {
  public:
    Utf8Locale() : locale_(newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)) {
        if (locale_ != nullptr) before_ = uselocale(locale_);
    }
    ~Utf8Locale() {
        if (locale_ == nullptr) return;
        uselocale(before_);
        freelocale(locale_);
    }
    Utf8Locale(const Utf8Locale&) = delete;
    Utf8Locale& operator=(const Utf8Locale&) = delete;

  private:
    locale_t locale_ = nullptr;
    locale_t before_ = nullptr;
};

[[noreturn]] void tooLarge(std::size_t packed) {
    throw Error(message<"limit.bundle/bytes">("max"_arg = maxUnpackedBytes(packed) >> 20U));
}

[[noreturn]] void damaged(archive* from) {
    const char* why = archive_error_string(from);
    throw Error(
        message<"bundle.damaged/archive">("problem"_arg = std::string_view(why ? why : "")));
}

std::string nameOf(archive_entry* entry) {
    std::string path;
    if (const char* name = archive_entry_pathname_utf8(entry))
        path = name;
    else if (const char* bytes = archive_entry_pathname(entry))
        path = latin1ToUtf8(bytes);
    else
        throw Error(message<"bundle.path/none">());
    std::replace(path.begin(), path.end(), '\\', '/');
    std::size_t begin = 0;
    while (path.compare(begin, 2, "./") == 0) begin += 2;
    return path.substr(begin);
}

void checkPath(const std::string& path) {
    const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
    if (!isSafePath(path) || std::any_of(path.begin(), path.end(), control))
        throw Error(message<"bundle.path">("path"_arg = path));
}

/// Returns the target of a link, as EntryReader::link; nothing for a file.
std::optional<std::string> linkOf(archive_entry* entry, const std::string& path) {
    constexpr std::size_t kMaxTargetBytes = 1024;
    const char* hard = archive_entry_hardlink(entry);
    const char* symbolic =
        archive_entry_filetype(entry) == AE_IFLNK ? archive_entry_symlink(entry) : nullptr;
    if (hard == nullptr && symbolic == nullptr) return std::nullopt;
    const string_view target = hard != nullptr ? hard : symbolic;
    if (target.empty() || target.front() == '/' || target.size() > kMaxTargetBytes) return "";
    // A hard link's target counts from the top, a symbolic link's from the link's folder.
    std::vector<string_view> parts;
    if (hard == nullptr) {
        parts = split(path, "/");
        parts.pop_back();
    }
    for (const string_view part : split(target, "/\\")) {
        if (part == ".") continue;
        if (part != "..") {
            parts.push_back(part);
        } else if (parts.empty()) {
            return "";
        } else {
            parts.pop_back();
        }
    }
    return nameToUtf8(joined(parts, "/"));
}

/// Refuses other methods of zip files: they allocate memory by sizes that the file gives.
void checkMethodOf(archive* from, const std::string& path) {
    const std::string format = archive_format_name(from);
    if (format.starts_with("ZIP") && format.find("deflation") == std::string::npos &&
        format.find("uncompressed") == std::string::npos)
        throw Error(message<"bundle.entry/method">("path"_arg = path, "method"_arg = format));
}

/// The bytes of a gzipped tar file, unpacked block by block, `most` of them at most: headers and
/// skipped entries count as well.
class Gunzipped {
  public:
    Gunzipped(string_view bytes, std::size_t most) : reader_(archive_read_new()), left_(most) {
        if (!reader_) throw std::bad_alloc();
        archive_read_support_format_raw(reader_.get());
        archive_read_support_filter_gzip(reader_.get());
        archive_entry* entry = nullptr;
        if (archive_read_open_memory(reader_.get(), bytes.data(), bytes.size()) != ARCHIVE_OK ||
            archive_read_next_header(reader_.get(), &entry) < ARCHIVE_WARN)
            damaged(reader_.get());
        constexpr int kOnce = 2;  // gzip, and the plain file below it
        if (archive_filter_count(reader_.get()) > kOnce)
            throw Error(message<"bundle.damaged/twice">());
    }
    bool isOver() const { return over_; }

    /// Reads for libarchive, which calls it.
    static la_ssize_t read(archive* tar, void* self, const void** block) {
        return static_cast<Gunzipped*>(self)->next(tar, block);
    }

  private:
    la_ssize_t next(archive* tar, const void** block) {
        const la_ssize_t got = archive_read_data(reader_.get(), block_.data(), block_.size());
        *block = block_.data();
        over_ = got > 0 && static_cast<std::size_t>(got) > left_;
        if (got < 0 || over_) {
            const char* why = archive_error_string(reader_.get());
            archive_set_error(tar, EINVAL, "%s", why != nullptr ? why : "the gzip file is damaged");
            return ARCHIVE_FATAL;
        }
        left_ -= static_cast<std::size_t>(got);
        return got;
    }

    Reader reader_;
    std::size_t left_;
    bool over_ = false;
    std::vector<char> block_ = std::vector<char>(kBlock);
};

/// Refuses a zip file whose directory is long: libarchive takes memory for all of it before the
/// first entry. Signatures in stored files are counted too, so that there is some room.
void checkDirectory(string_view bytes) {
    constexpr string_view kSignature = "PK\1\2";
    std::size_t left = 2 * Assets::kMaxListed;
    for (std::size_t at = 0; (at = bytes.find(kSignature, at)) != string_view::npos;
         at += kSignature.size())
        if (left-- == 0) tooManyEntries();
}

std::size_t maxPassedBytes(std::size_t packed) {
    return std::min(kMaxPassed, std::max(kFreeBytes, packed * kMaxRatio));
}

/// Returns the size in the archive's directory, 0 if unknown.
std::uint64_t sizeOf(archive_entry* entry) {
    if (archive_entry_size_is_set(entry) == 0) return 0;
    const la_int64_t size = archive_entry_size(entry);
    return size < 0 ? std::numeric_limits<std::uint64_t>::max() : static_cast<std::uint64_t>(size);
}

}  // namespace

void tooManyEntries() {
    throw Error(message<"limit.bundle/entries">("max"_arg = Assets::kMaxListed));
}

std::size_t maxUnpackedBytes(std::size_t packed) {
    return std::min(kMaxBundleBytes, std::max(kFreeBytes, packed * kMaxRatio));
}

bool isArchive(string_view bytes) {
    constexpr std::size_t kTarMagic = 257;
    return bytes.starts_with(string_view("PK\3\4")) || bytes.starts_with(string_view("PK\5\6")) ||
           bytes.starts_with(kGzip) || bytes.starts_with(kSevenZip) || bytes.starts_with(kRar) ||
           (bytes.size() > kTarMagic && bytes.substr(kTarMagic).starts_with("ustar"));
}

struct EntryReader::Open {
    Utf8Locale locale;
    std::optional<Gunzipped> gunzipped;  // outlives the reader
    Reader reader{archive_read_new()};
    archive_entry* entry = nullptr;
};

EntryReader::EntryReader(string_view bytes)
    : packed_(bytes.size()),
      passable_(maxPassedBytes(bytes.size())),
      open_(std::make_unique<Open>()) {
    archive* const reader = open_->reader.get();
    if (reader == nullptr) throw std::bad_alloc();
    int result = ARCHIVE_OK;
    if (bytes.starts_with(kGzip)) {
        archive_read_support_format_tar(reader);
        const std::size_t heads = std::min(Assets::kMaxListed * kHeadBytes, passable_);
        open_->gunzipped.emplace(bytes, passable_ + heads);
        result = archive_read_open(reader, &*open_->gunzipped, nullptr, Gunzipped::read, nullptr);
    } else {
        isSolid_ = bytes.starts_with(kSevenZip) || bytes.starts_with(kRar);
        if (isSolid_) {
            archive_read_support_format_7zip(reader);
            archive_read_support_format_rar(reader);
            archive_read_support_format_rar5(reader);
        } else {
            checkDirectory(bytes);
            archive_read_support_format_tar(reader);
            archive_read_support_format_zip_seekable(reader);
        }
        result = archive_read_open_memory(reader, bytes.data(), bytes.size());
    }
    if (result != ARCHIVE_OK) fail();
}

EntryReader::~EntryReader() = default;

bool EntryReader::next() {
    for (;;) {
        const int result = archive_read_next_header(open_->reader.get(), &open_->entry);
        if (result == ARCHIVE_EOF) return false;
        if (result < ARCHIVE_WARN) fail();
        if (entries_++ == Assets::kMaxListed) tooManyEntries();
        before_ += size_;
        size_ = sizeOf(open_->entry);
        path_ = nameOf(open_->entry);
        if (isClutter(path_)) continue;
        link_ = linkOf(open_->entry, path_);
        if (!link_ && archive_entry_filetype(open_->entry) != AE_IFREG) continue;
        checkPath(path_);
        return true;
    }
}

std::string EntryReader::content(std::size_t left) {
    if (archive_entry_is_encrypted(open_->entry) != 0)
        throw Error(message<"bundle.entry">("path"_arg = path_));
    checkMethodOf(open_->reader.get(), path_);
    // Entries before one of a solid archive are unpacked to reach it.
    if (size_ > left || (isSolid_ && (before_ > passable_ || size_ > passable_ - before_)))
        tooLarge(packed_);
    std::string content;
    for (;;) {
        const std::size_t had = content.size();
        content.resize(std::min(had + kBlock, left + 1));
        const la_ssize_t got =
            archive_read_data(open_->reader.get(), content.data() + had, content.size() - had);
        if (got < 0) fail();
        content.resize(had + static_cast<std::size_t>(got));
        if (content.size() > left) tooLarge(packed_);
        if (got == 0) break;
    }
    return content;
}

void EntryReader::fail() const {
    if (open_->gunzipped && open_->gunzipped->isOver()) tooLarge(packed_);
    damaged(open_->reader.get());
}

}  // namespace farol::scene
