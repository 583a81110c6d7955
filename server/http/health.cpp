#include "server/http/health.h"

#include <httplib.h>

#include <regex>

#include "core/error.h"
#include "server/messages.h"

namespace farol::server::http {

Health askHealth(const std::string& url, std::chrono::milliseconds patience) {
    static const std::regex kUrl(R"(http://(\[[0-9a-fA-F:.]+\]|[A-Za-z0-9._-]+)(:[0-9]{1,5})?/?)");
    if (url.size() > 512 || !std::regex_match(url, kUrl))
        throw Error(message<"option.range/health-url">("value"_arg = url), {}, "URL");
    httplib::Client client(url.back() == '/' ? url.substr(0, url.size() - 1) : url);
    client.set_connection_timeout(patience);
    client.set_read_timeout(patience);
    client.set_write_timeout(patience);
    const httplib::Result answer = client.Get("/readyz");
    if (answer.error() == httplib::Error::Connection)
        return {false, "nothing answers there: does the service run?"};
    if (!answer) return {false, "no answer: " + httplib::to_string(answer.error())};
    const std::string line =
        answer->body.substr(0, std::min<std::size_t>(answer->body.find('\n'), 200));
    return {answer->status == 200, "HTTP " + std::to_string(answer->status) + " " + line};
}

}  // namespace farol::server::http
