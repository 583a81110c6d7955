#include "core/build_id.h"

#include <elf.h>
#include <link.h>

#include <cstdint>
#include <string_view>

#include "core/digest.h"

namespace farol {
namespace {

/// The build ids of loaded objects.
struct Ids {
    std::string_view prefix;  // of the file names of objects that count; empty: all count
    std::string all;
};

/// Appends the NT_GNU_BUILD_ID note of a loaded object (elf(5)), if it has one.
int appendBuildId(dl_phdr_info* info, std::size_t, void* out) {
    auto& ids = *static_cast<Ids*>(out);
    std::string_view file(info->dlpi_name == nullptr ? "" : info->dlpi_name);
    file.remove_prefix(file.rfind('/') + 1);  // npos + 1 is 0
    if (!file.starts_with(ids.prefix)) return 0;
    for (int i = 0; i < info->dlpi_phnum; ++i) {
        const ElfW(Phdr)& header = info->dlpi_phdr[i];
        if (header.p_type != PT_NOTE) continue;
        const char* at = reinterpret_cast<const char*>(info->dlpi_addr + header.p_vaddr);
        const char* end = at + header.p_memsz;
        const auto padded = [](std::size_t size) { return (size + 3) & ~std::size_t{3}; };
        while (at + sizeof(ElfW(Nhdr)) <= end) {
            const auto* note = reinterpret_cast<const ElfW(Nhdr)*>(at);
            const char* name = at + sizeof(ElfW(Nhdr));
            const char* content = name + padded(note->n_namesz);
            at = content + padded(note->n_descsz);
            if (at > end) break;
            if (note->n_type == NT_GNU_BUILD_ID &&
                std::string_view(name, note->n_namesz) == std::string_view("GNU\0", 4))
                ids.all.append(content, note->n_descsz);
        }
    }
    return 0;
}

}  // namespace

std::string buildId() {
    static const std::string id = [] {
        Ids ids;
        dl_iterate_phdr(appendBuildId, &ids);
        return contentDigest(ids.all).substr(0, 16);
    }();
    return id;
}

std::string buildIdWith(std::initializer_list<std::string_view> libraries) {
    Ids ids{"", buildId()};
    for (const std::string_view library : libraries) {
        ids.prefix = library;
        dl_iterate_phdr(appendBuildId, &ids);
    }
    return contentDigest(ids.all).substr(0, 16);
}

}  // namespace farol
