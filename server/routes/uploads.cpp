#include "server/routes/uploads.h"

#include "core/digest.h"
#include "core/text.h"
#include "server/messages.h"

namespace farol::server {

scene::Bundle bundleOf(const render::Job& job) {
    const scene::Assets& files = *job.assets;
    const auto needed = scene::neededFiles(files, files.list(), scene::kMaxBundleBytes);
    scene::Bundle bundle{job.name, scene::readFiles(files, needed, scene::kMaxBundleBytes)};
    bundle.files.insert_or_assign(job.name, job.xml);
    return bundle;
}

Upload takeUpload(const Context& context, const Call& call, const std::string& base) {
    Upload upload = readUpload(call.request, call.body, context.options.maxBodyBytes);
    if (base.empty()) {
        if (!upload.without.empty()) throw Error(message<"option.range/without">(), {}, "without");
        return upload;
    }
    if (!upload.bundle) throw Error(message<"option.range/base">(), {}, "base");
    ServedScene scene = context.scenes.find(base);
    Upload out;
    out.optionsJson = upload.optionsJson;
    out.job = context.scenes.jobOf(scene);
    out.job.xml = upload.job.xml;
    std::string identity = out.job.identity + "\n" + upload.job.identity;
    if (upload.bundle->files.size() > 1 || !upload.without.empty()) {
        // The document's name stays the base's; files that were sent replace those of their paths.
        auto merged = std::make_shared<scene::Bundle>(bundleOf(out.job));
        for (const std::string& path : upload.without)
            if (path != merged->main) merged->files.erase(path);
        for (const auto& [path, content] : upload.bundle->files)
            if (path != upload.bundle->main && path != merged->main)
                merged->files.insert_or_assign(path, content);
        identity += "\n" + joined(upload.without, "\n");
        out.bundle = std::move(merged);
        out.job = jobOf(out.bundle, contentDigest(identity));
    }
    out.job.identity = contentDigest(identity);
    return out;
}

}  // namespace farol::server
