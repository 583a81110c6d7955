#include "server/routes/answers.h"

#include <nlohmann/json.hpp>

#include "server/etag.h"
#include "server/request/media.h"
#include "server/request/parameters.h"
#include "server/request/problem.h"

namespace farol::server {

http::Response jsonResponse(const nlohmann::json& value) {
    http::Response response;
    response.contentType = "application/json";
    response.body = dump(value, 2) + "\n";
    return response;
}

http::Response freshJson(const nlohmann::json& value) {
    http::Response response = jsonResponse(value);
    response.set("Cache-Control", "no-store");
    return response;
}

http::Response freshJson(const nlohmann::json& value, Language language) {
    http::Response response = freshJson(value);
    setLanguage(response, language);
    return response;
}

namespace {
http::Response withTag(const Call& call, std::string body, const std::string& type,
                       const std::string& tag) {
    http::Response response;
    response.set("ETag", tag);
    if (matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
        return response;
    }
    response.contentType = type;
    response.body = std::move(body);
    return response;
}
}  // namespace

http::Response tagged(const Call& call, std::string body, const std::string& type) {
    const std::string tag = entityTag({body});
    return withTag(call, std::move(body), type, tag);
}

http::Response taggedJson(const Call& call, const nlohmann::json& value, Language language) {
    std::string body = dump(value, 2) + "\n";
    const std::string tag = entityTag({body, kLanguageWords[language]});
    http::Response response = withTag(call, std::move(body), "application/json", tag);
    setLanguage(response, language);
    return response;
}

void refuseParameters(const Call& call) { readParameters(call.request.query, {}); }

}  // namespace farol::server
