#include "scene/archive.h"

#include <archive.h>
#include <archive_entry.h>
#include <locale.h>

#include <algorithm>
#include <memory>

#include "scene/assets.h"
#include "scene/words.h"

namespace farol::scene {
namespace {

using std::string_view;

constexpr int kMaxEntries = 1024;  // with folders and what is skipped
// Deflate makes 1032 bytes of one at most. Pictures and meshes stay far below this; text full of
// blanks reaches it, so that small bundles are not held to it.
constexpr std::size_t kMaxRatio = 200;
constexpr std::size_t kFreeBytes = std::size_t{4} << 20U;
constexpr std::size_t kBlock = 64 * 1024;

struct Closer {
    void operator()(archive* one) const { archive_read_free(one); }
};
using Reader = std::unique_ptr<archive, Closer>;

/// Names in archives are UTF-8 where they are anything; the library asks the locale.
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

std::size_t allowedBytes(std::size_t packed) {
    return std::min(kMaxBundleBytes, std::max(kFreeBytes, packed * kMaxRatio));
}

[[noreturn]] void tooLarge(std::size_t packed) {
    throw Error("limit.bundle", "The archive's files are larger than " +
                                    std::to_string(allowedBytes(packed) >> 20U) +
                                    " MiB, the most for one of its size.");
}

[[noreturn]] void damaged(archive* from) {
    const char* why = archive_error_string(from);
    throw Error("bundle.damaged",
                "The archive cannot be read" +
                    (why == nullptr ? std::string(".") : ": " + shown(why) + "."));
}

std::string nameOf(archive_entry* entry) {
    const char* name = archive_entry_pathname_utf8(entry);
    if (name == nullptr) name = archive_entry_pathname(entry);
    if (name == nullptr) throw Error("bundle.path", "The archive has a file without a name.");
    std::string path = name;
    std::replace(path.begin(), path.end(), '\\', '/');
    while (path.starts_with("./")) path.erase(0, 2);
    return path;
}

bool isClutter(const std::string& path) {
    const std::string base = path.substr(path.rfind('/') + 1);
    return path.starts_with("__MACOSX/") || base.starts_with("._") || base == ".DS_Store";
}

void checkPath(const std::string& path) {
    const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
    if (!isSafePath(path) || std::any_of(path.begin(), path.end(), control))
        throw Error("bundle.path",
                    "The name " + quoted(path) + " in the archive is not a relative path.");
}

void checkKind(archive* from, archive_entry* entry, const std::string& path) {
    if (archive_entry_is_encrypted(entry) != 0)
        throw Error("bundle.entry", quoted(path) + " in the archive is encrypted.");
    if (archive_entry_filetype(entry) != AE_IFREG || archive_entry_hardlink(entry) != nullptr)
        throw Error("bundle.entry", quoted(path) + " in the archive is a link or a device.");
    // Other methods take memory by what the file says of itself.
    const std::string format = archive_format_name(from);
    if (format.starts_with("ZIP") && format.find("deflation") == std::string::npos &&
        format.find("uncompressed") == std::string::npos)
        throw Error("bundle.entry", quoted(path) + " in the archive is packed by " + shown(format) +
                                        "; only stored and deflated files are read.");
}

/// The file's bytes, `left` at most.
std::string contentOf(archive* from, std::size_t left, std::size_t packed) {
    std::string content;
    for (;;) {
        const std::size_t had = content.size();
        content.resize(std::min(had + kBlock, left + 1));
        const la_ssize_t got = archive_read_data(from, content.data() + had, content.size() - had);
        if (got < 0) damaged(from);
        content.resize(had + static_cast<std::size_t>(got));
        if (got == 0) return content;
        if (content.size() > left) tooLarge(packed);
    }
}

/// Takes off the folder that holds everything, and the one in that.
void stripTop(std::map<std::string, std::string>& files) {
    for (;;) {
        if (files.empty()) return;
        const std::size_t slash = files.begin()->first.find('/');
        if (slash == std::string::npos) return;
        const std::string top = files.begin()->first.substr(0, slash + 1);
        for (const auto& [path, content] : files)
            if (!path.starts_with(top)) return;
        std::map<std::string, std::string> stripped;
        for (auto& [path, content] : files)
            stripped.emplace(path.substr(top.size()), std::move(content));
        files = std::move(stripped);
    }
}

Reader opened(string_view bytes) {
    Reader reader(archive_read_new());
    if (!reader) throw std::bad_alloc();
    archive_read_support_format_zip_seekable(reader.get());
    archive_read_support_format_tar(reader.get());
    archive_read_support_filter_gzip(reader.get());
    if (archive_read_open_memory(reader.get(), bytes.data(), bytes.size()) != ARCHIVE_OK)
        damaged(reader.get());
    return reader;
}

}  // namespace

bool isArchive(string_view bytes) {
    constexpr std::size_t kTarMagic = 257;
    return bytes.starts_with(string_view("PK\3\4")) || bytes.starts_with(string_view("PK\5\6")) ||
           bytes.starts_with("\x1f\x8b") ||
           (bytes.size() > kTarMagic && bytes.substr(kTarMagic).starts_with("ustar"));
}

std::map<std::string, std::string> readFiles(string_view bytes) {
    const Utf8Locale locale;
    const Reader reader = opened(bytes);
    const std::size_t allowed = allowedBytes(bytes.size());
    std::map<std::string, std::string> files;
    std::size_t taken = 0;
    archive_entry* entry = nullptr;
    for (int entries = 0;; ++entries) {
        const int result = archive_read_next_header(reader.get(), &entry);
        if (result == ARCHIVE_EOF) break;
        if (result < ARCHIVE_WARN) damaged(reader.get());
        if (entries == kMaxEntries)
            throw Error("limit.bundle",
                        "The archive has more than " + std::to_string(kMaxEntries) + " entries.");
        // What is skipped is unpacked too, to get past it.
        if (archive_entry_size_is_set(entry) != 0 &&
            (archive_entry_size(entry) < 0 ||
             static_cast<std::size_t>(archive_entry_size(entry)) > allowed - taken))
            tooLarge(bytes.size());
        const std::string path = nameOf(entry);
        if (archive_entry_filetype(entry) == AE_IFDIR || isClutter(path)) continue;
        checkPath(path);
        checkKind(reader.get(), entry, path);
        if (files.size() == kMaxBundleFiles)
            throw Error("limit.bundle",
                        "The archive has more than " + std::to_string(kMaxBundleFiles) + " files.");
        if (files.count(path) != 0)
            throw Error("bundle.path", "The file " + quoted(path) + " is in the archive twice.");
        std::string content = contentOf(reader.get(), allowed - taken, bytes.size());
        taken += content.size();
        files.emplace(path, std::move(content));
    }
    stripTop(files);
    return files;
}

Bundle readArchive(string_view bytes) {
    Bundle bundle;
    bundle.files = readFiles(bytes);
    bundle.main = mainOf(bundle.files);
    return bundle;
}

}  // namespace farol::scene
