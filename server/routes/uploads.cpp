#include "server/routes/uploads.h"

#include "core/digest.h"
#include "server/messages.h"

namespace farol::server {

Upload takeUpload(const Context& context, const Call& call, const std::string& base) {
    Upload upload = readUpload(call.request, call.body, context.options.maxBodyBytes);
    if (base.empty()) return upload;
    if (!upload.bundle || upload.bundle->files.size() != 1)
        throw Error(message<"option.range/base">(), {}, "base");
    ServedScene scene = context.scenes.find(base);
    Upload out;
    out.optionsJson = upload.optionsJson;
    out.job = context.scenes.jobOf(scene);
    out.job.xml = upload.job.xml;
    out.job.identity = contentDigest(out.job.identity + "\n" + upload.job.identity);
    return out;
}

}  // namespace farol::server
