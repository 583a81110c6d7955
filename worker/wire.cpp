#include "worker/wire.h"

namespace farol::worker {

TravellingAssets departing(const scene::Assets* assets) {
    TravellingAssets out;
    if (const auto* served = dynamic_cast<const scene::FolderAssets*>(assets)) {
        out.isFolder = true;
        out.folder = served->root();
    } else if (assets != nullptr) {
        for (const std::string& path : assets->list())
            if (auto bytes = assets->read(path)) out.files.emplace(path, std::move(*bytes));
    }
    return out;
}

std::shared_ptr<const scene::Assets> arrived(TravellingAssets assets) {
    if (assets.isFolder) return std::make_shared<scene::FolderAssets>(assets.folder);
    return std::make_shared<scene::BundleAssets>(std::move(assets.files));
}

}  // namespace farol::worker
