#include <nlohmann/json.hpp>

#include "server/json.h"
#include "server/request/media.h"
#include "server/request/parameters.h"
#include "server/routes/answers.h"
#include "server/routes/uploads.h"
#include "worker/tasks/inspect.h"

namespace farol::server {

http::Response postValidate(Context& context, const Call& call) {
    const Parameters wanted =
        readParameters(call.request.query, {false, true, {"base", "models"}, {}});
    const bool models = wholeNumber("models", wanted.ownValue("models", "0"), 0, 1) == 1;
    Upload upload = takeUpload(context, call, wanted.ownValue("base"));
    upload.job.strict = wanted.strict;
    const auto done = context.backend.run<worker::InspectTask>({std::move(upload.job)});
    const Language language = languageOf(call.request);
    nlohmann::json body = toJson(done.result, language);
    body["valid"] = true;
    if (models) body.update(modelsOf(done.result));
    return freshJson(body, language);
}

}  // namespace farol::server
