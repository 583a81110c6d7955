#include "server/store/disk_records.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "core/digest.h"
#include "core/number.h"
#include "server/messages.h"
#include "server/store/files.h"
#include "worker/backend.h"

namespace farol::server::store {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kRecordMagic = "farol-record 1 ";
constexpr std::size_t kRecordDigits = 32;
constexpr std::size_t kMaxRecordBytes = std::size_t{2} << 30U;  // more than a body can be

/// "farol-record 1 DIGEST\nSECONDS\nBYTES"; SECONDS since 1970, 0: never.
std::string encode(const std::string& bytes, Time expires) {
    const std::int64_t seconds =
        expires == Time::max()
            ? 0
            : std::chrono::ceil<std::chrono::seconds>(expires.time_since_epoch()).count();
    const std::string body = std::to_string(seconds) + "\n" + bytes;
    return std::string(kRecordMagic) + contentDigest(body) + "\n" + body;
}

std::optional<Time> expiryOf(std::string_view text) {
    constexpr std::int64_t kLatest = 9'000'000'000;  // limit of the clock's nanoseconds
    const auto seconds = parseExact<std::int64_t>(text);
    if (!seconds || *seconds < 0 || *seconds > kLatest) return std::nullopt;
    return *seconds == 0 ? Time::max() : Time(std::chrono::seconds(*seconds));
}

struct Record {
    Time expires;
    std::string_view bytes;
};

std::optional<Record> decode(std::string_view file) {
    constexpr std::size_t kHead = kRecordMagic.size() + kRecordDigits + 1;
    if (file.size() < kHead || !file.starts_with(kRecordMagic) || file[kHead - 1] != '\n')
        return std::nullopt;
    const std::string_view body = file.substr(kHead);
    if (contentDigest(body) != file.substr(kRecordMagic.size(), kRecordDigits)) return std::nullopt;
    const std::size_t end = body.find('\n');
    const auto expires = expiryOf(body.substr(0, end));
    if (end == std::string_view::npos || !expires) return std::nullopt;
    return Record{*expires, body.substr(end + 1)};
}

}  // namespace

DiskRecords::DiskRecords(const std::string& folder, std::uint64_t maxBytes, Log log)
    : folder_(folder + "/records"), maxBytes_(maxBytes), log_(std::move(log)) {
    std::error_code failed;
    fs::create_directories(folder_ + "/new", failed);
    if (failed)
        throw std::runtime_error("the folder " + folder_ + " cannot be made: " + failed.message());
    for (const auto& left : fs::directory_iterator(folder_ + "/new"))
        fs::remove(left.path(), failed);  // one that stays is overwritten
    for (const auto& file : fs::recursive_directory_iterator(folder_))
        if (file.is_regular_file(failed)) bytes_ += sizeOf(file.path().string());
}

std::string DiskRecords::pathOf(const std::string& table, const std::string& key) const {
    return folder_ + "/" + table + "/" + key;
}

std::uint64_t DiskRecords::sizeOf(const std::string& path) {
    std::error_code failed;
    const std::uintmax_t size = fs::file_size(path, failed);
    return failed ? 0 : size;
}

void DiskRecords::put(const std::string& table, const std::string& key, const std::string& bytes,
                      Time expires) {
    const std::string file = encode(bytes, expires), path = pathOf(table, key);
    const std::lock_guard lock(mutex_);
    const std::uint64_t before = sizeOf(path);
    if (bytes_ - before + file.size() > maxBytes_)
        throw worker::Busy(message<"store.full">(), kRoomRetryS);
    std::error_code failed;
    fs::create_directories(folder_ + "/" + table, failed);
    const int error = failed ? failed.value() : writeDurably(folder_ + "/new/" + key, path, file);
    if (error != 0) {
        log_("record " + table + "/" + key + " cannot be stored: " + std::strerror(error));
        const bool isFull = error == ENOSPC || error == EDQUOT || error == EFBIG;
        throw worker::Busy(isFull ? message<"store.full">() : message<"store.failed">(),
                           kRoomRetryS);
    }
    bytes_ += file.size() - before;
}

std::optional<std::string> DiskRecords::get(const std::string& table, const std::string& key) {
    const std::string path = pathOf(table, key);
    const FileContent file = readWhole(path, kMaxRecordBytes);
    if (file.kind == FileContent::Kind::failed) {
        log_("record " + table + "/" + key + " cannot be read: " + std::strerror(file.error));
        throw worker::Busy(message<"store.failed/read">(), kReadRetryS);
    }
    if (file.kind == FileContent::Kind::missing) return std::nullopt;
    const auto record = decode(file.bytes);
    if (!record) log_("record " + table + "/" + key + " is damaged");
    if (!record || record->expires <= now()) return std::nullopt;
    return std::string(record->bytes);
}

// The caller holds mutex_.
bool DiskRecords::drop(const std::string& path) {
    const std::uint64_t size = sizeOf(path);
    if (const int error = removeDurably(path); error != 0) {
        log_(path + " cannot be removed: " + std::strerror(error));
        return false;
    }
    bytes_ -= size;
    return true;
}

bool DiskRecords::remove(const std::string& table, const std::string& key) {
    const std::string path = pathOf(table, key);
    const std::lock_guard lock(mutex_);
    std::error_code failed;
    if (!fs::exists(path, failed)) return false;
    if (!drop(path)) throw worker::Busy(message<"store.failed/remove">(), kRoomRetryS);
    return true;
}

std::vector<std::string> DiskRecords::keys(const std::string& table) {
    std::vector<std::string> out;
    std::error_code failed;
    for (const auto& file : fs::directory_iterator(folder_ + "/" + table, failed))
        if (out.size() < kMaxKeys) out.push_back(file.path().filename().string());
    if (failed && failed != std::errc::no_such_file_or_directory)
        throw worker::Busy(message<"store.failed/read">(), kReadRetryS);
    std::sort(out.begin(), out.end());
    return out;
}

std::size_t DiskRecords::expire() {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> over;
    std::error_code failed;
    for (const auto& file : fs::recursive_directory_iterator(folder_, failed)) {
        if (!file.is_regular_file(failed)) continue;
        std::ifstream bytes(file.path());
        std::string head, seconds;
        if (!std::getline(bytes, head) || !std::getline(bytes, seconds)) continue;
        const auto expires = expiryOf(seconds);
        if (head.starts_with(kRecordMagic) && expires && *expires <= now())
            over.push_back(file.path().string());
    }
    return static_cast<std::size_t>(std::count_if(
        over.begin(), over.end(), [this](const std::string& path) { return drop(path); }));
}

}  // namespace farol::server::store
