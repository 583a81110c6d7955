-- For wrk: the same scene from another side with each request (arguments: path), and how often each
-- status was answered.
local threads = {}

function setup(thread)
    thread:set("number", #threads)
    table.insert(threads, thread)
end

function init(arguments)
    path = arguments[1]
    turns = arguments[2] == "turn"
    at = number * 7919
    statuses = ""
    counts = {}
end

function request()
    if not turns then return wrk.format("GET", path) end
    at = at + 1
    return wrk.format("GET", string.format("%s&azimuth=%.3f", path, (at * 222.4922359) % 360))
end

function response(status)
    counts[status] = (counts[status] or 0) + 1
    if counts[status] == 1 then statuses = statuses .. status .. " " end
    _G["count" .. status] = counts[status]
end

function done(summary, latency)
    local all = {}
    for _, thread in ipairs(threads) do
        for status in thread:get("statuses"):gmatch("%d+") do
            all[status] = (all[status] or 0) + thread:get("count" .. status)
        end
    end
    io.write("statuses")
    for status, count in pairs(all) do io.write(" " .. status .. "=" .. count) end
    io.write(string.format("\nseconds %.6f\np50ms %.3f\np99ms %.3f\n", summary.duration / 1e6,
        latency:percentile(50) / 1e3, latency:percentile(99) / 1e3))
end
