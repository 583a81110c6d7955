#include "cli/class_archive.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "cli/messages.h"
#include "cli/zip_writer.h"
#include "core/error.h"
#include "core/text.h"
#include "scene/files/assets.h"

namespace farol::cli {
namespace {

// The format: PKWARE's APPNOTE 6.3, sections 4.3.7 (local header), 4.3.12 and 4.3.16 (directory).
constexpr std::uint64_t kMaxArchiveBytes = std::uint64_t{2} << 30U;
constexpr std::size_t kMaxDirectoryBytes = std::size_t{64} << 20U;
constexpr std::string_view kLocal = "PK\3\4", kEntry = "PK\1\2", kEnd = "PK\5\6";
constexpr std::size_t kLocalBytes = 30, kEntryBytes = 46, kEndBytes = 22;
constexpr std::size_t kMaxComment = 65'535;
constexpr std::uint16_t kEncrypted = 1;

template <typename Number>
Number numberAt(std::string_view bytes, std::size_t at) {
    Number value = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        value = static_cast<Number>(
            value | (static_cast<Number>(static_cast<unsigned char>(bytes[at + i])) << (8 * i)));
    return value;
}

int openRegular(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0)
        throw Error(
            message<"asset.missing/input">("reason"_arg = std::generic_category().message(errno)),
            {path, 0, 0});
    return descriptor;
}

}  // namespace

ClassArchive::ClassArchive(const std::string& path) : path_(path), file_(openRegular(path)) {
    struct stat status {};
    if (::fstat(file_.get(), &status) != 0 || !S_ISREG(status.st_mode)) damaged();
    size_ = static_cast<std::uint64_t>(status.st_size);
    if (size_ > kMaxArchiveBytes)
        throw Error(message<"limit.file-bytes">("max"_arg = kMaxArchiveBytes >> 20U), {path, 0, 0});
    if (size_ < kEndBytes) damaged();
    const std::size_t tailBytes =
        static_cast<std::size_t>(std::min<std::uint64_t>(size_, kEndBytes + kMaxComment));
    const std::string tail = readAt(size_ - tailBytes, tailBytes);
    const std::size_t end = tail.rfind(kEnd);
    if (end == std::string::npos || tail.size() - end < kEndBytes) damaged();
    const auto count = numberAt<std::uint16_t>(tail, end + 10);
    const auto bytes = numberAt<std::uint32_t>(tail, end + 12),
               offset = numberAt<std::uint32_t>(tail, end + 16);
    if (bytes > kMaxDirectoryBytes || offset > size_ || bytes > size_ - offset) damaged();
    const std::string directory = readAt(offset, bytes);
    for (std::size_t at = 0; records_.size() < count;) {
        if (directory.size() - at < kEntryBytes || directory.compare(at, 4, kEntry) != 0) damaged();
        const auto nameBytes = numberAt<std::uint16_t>(directory, at + 28),
                   extra = numberAt<std::uint16_t>(directory, at + 30),
                   comment = numberAt<std::uint16_t>(directory, at + 32);
        const std::size_t whole = kEntryBytes + nameBytes + extra + comment;
        if (directory.size() - at < whole) damaged();
        records_.push_back({numberAt<std::uint16_t>(directory, at + 4),
                            numberAt<std::uint16_t>(directory, at + 8),
                            numberAt<std::uint16_t>(directory, at + 10),
                            numberAt<std::uint16_t>(directory, at + 12),
                            numberAt<std::uint16_t>(directory, at + 14),
                            numberAt<std::uint32_t>(directory, at + 16),
                            numberAt<std::uint32_t>(directory, at + 20),
                            numberAt<std::uint32_t>(directory, at + 24),
                            numberAt<std::uint32_t>(directory, at + 38),
                            numberAt<std::uint32_t>(directory, at + 42)});
        std::string name = nameToUtf8(directory.substr(at + kEntryBytes, nameBytes));
        std::replace(name.begin(), name.end(), '\\', '/');
        entries_.push_back({std::move(name), records_.back().packed});
        at += whole;
    }
}

std::string ClassArchive::packed(const std::vector<std::size_t>& entries,
                                 const std::vector<std::string>& names,
                                 std::size_t maxBytes) const {
    std::string out;
    ZipWriter zip([&](std::string_view bytes) { out += bytes; });
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Record& record = records_.at(entries[i]);
        if (record.packed > maxBytes || out.size() > maxBytes - record.packed)
            throw Error(message<"limit.bundle/submission">("max"_arg = maxBytes >> 20U),
                        {path_, 0, 0});
        const std::string head = readAt(record.offset, kLocalBytes);
        if (head.compare(0, 4, kLocal) != 0) damaged();
        const std::uint64_t data = std::uint64_t{record.offset} + kLocalBytes +
                                   numberAt<std::uint16_t>(head, 26) +
                                   numberAt<std::uint16_t>(head, 28);
        if ((record.flags & kEncrypted) != 0)
            throw Error(message<"bundle.entry/encrypted">("path"_arg = uncut(names.at(i))),
                        {path_, 0, 0});
        zip.add({names.at(i), record.madeBy, record.method, record.time, record.date, record.crc,
                 record.size, record.attributes, readAt(data, record.packed)});
    }
    zip.finish();
    return out;
}

std::string ClassArchive::readAt(std::uint64_t offset, std::size_t size) const {
    if (offset > size_ || size > size_ - offset) damaged();
    std::string bytes(size, '\0');
    for (std::size_t at = 0; at < size;) {
        const ssize_t got =
            ::pread(file_.get(), bytes.data() + at, size - at, static_cast<off_t>(offset + at));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) damaged();
        at += static_cast<std::size_t>(got);
    }
    return bytes;
}

void ClassArchive::damaged() const {
    throw Error(message<"bundle.damaged/class">(), {path_, 0, 0});
}

}  // namespace farol::cli
