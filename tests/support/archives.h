#pragma once

#include <archive.h>
#include <archive_entry.h>

#include <stdexcept>
#include <string>
#include <vector>

/// Archives as tests need them, well-formed and hostile.
namespace farol::test {

struct Packed {
    std::string path, content;
    unsigned kind = AE_IFREG;
    std::string link = {};      ///< of a symbolic link
    std::string hardlink = {};  ///< to another entry
    la_int64_t claims = -1;     ///< size in the head, where it is not the content's
};

enum class Packing { zip, zipStored, tar, tarGz, sevenZip };

inline std::string pack(Packing packing, const std::vector<Packed>& entries) {
    archive* out = archive_write_new();
    const bool zip = packing == Packing::zip || packing == Packing::zipStored;
    if (packing == Packing::sevenZip)
        archive_write_set_format_7zip(out);
    else
        zip ? archive_write_set_format_zip(out) : archive_write_set_format_pax_restricted(out);
    if (packing == Packing::zip) archive_write_zip_set_compression_deflate(out);
    if (packing == Packing::zipStored) archive_write_zip_set_compression_store(out);
    if (packing == Packing::tarGz) archive_write_add_filter_gzip(out);
    std::size_t size = std::size_t{1} << 20U, used = 0;
    for (const Packed& one : entries) size += one.content.size() + one.path.size() + 4096;
    std::string bytes(size, '\0');
    archive_write_set_bytes_in_last_block(out, 1);
    archive_write_open_memory(out, bytes.data(), bytes.size(), &used);
    for (const Packed& one : entries) {
        archive_entry* entry = archive_entry_new();
        archive_entry_set_pathname(entry, one.path.c_str());
        archive_entry_set_filetype(entry, one.kind);
        archive_entry_set_perm(entry, 0644);
        if (!one.link.empty()) archive_entry_set_symlink(entry, one.link.c_str());
        if (!one.hardlink.empty()) archive_entry_set_hardlink(entry, one.hardlink.c_str());
        const bool file = one.kind == AE_IFREG && one.hardlink.empty();
        archive_entry_set_size(entry, !file ? 0
                                      : one.claims >= 0
                                          ? one.claims
                                          : static_cast<la_int64_t>(one.content.size()));
        if (archive_write_header(out, entry) < ARCHIVE_WARN)
            throw std::runtime_error(archive_error_string(out));
        if (file) archive_write_data(out, one.content.data(), one.content.size());
        archive_entry_free(entry);
    }
    archive_write_close(out);
    archive_write_free(out);
    bytes.resize(used);
    return bytes;
}

}  // namespace farol::test
