#pragma once

/// Scripts that Redis runs atomically (redis.io, "Scripting with Lua"). KEYS[1] is the prefix of
/// all keys; in :scene:ID is a scene's file, and beside it, by id: in :sizes its bytes, in :used
/// when it was last asked for (us since 1970), in :expiry when it ends (ms), in :listed those of
/// the gallery; :total is the sum of the sizes. In :aside:ID is a file that did not match its
/// digest.
namespace farol::server::store::redis {

/// Of all keys, with a hash tag: in a cluster, one node has all keys, as the scripts need.
inline constexpr const char* kPrefix = "{farol}";

inline constexpr const char* kCommon = R"(
local function at(name) return KEYS[1] .. ':' .. name end
local clock = redis.call('TIME')
local moment = clock[1] * 1000000 + clock[2]
local now = math.floor(moment / 1000)
local function drop(id)
  local had = redis.call('DEL', at('scene:' .. id))
  local size = redis.call('HGET', at('sizes'), id)
  if size then
    redis.call('DECRBY', at('total'), size)
    redis.call('HDEL', at('sizes'), id)
    redis.call('ZREM', at('used'), id)
    redis.call('ZREM', at('expiry'), id)
    redis.call('SREM', at('listed'), id)
  end
  return had
end
local function expire()
  local ended = redis.call('ZRANGEBYSCORE', at('expiry'), '-inf', now, 'LIMIT', 0, 1000)
  for _, id in ipairs(ended) do drop(id) end
  return #ended
end
local function entry(id)
  return {redis.call('SISMEMBER', at('listed'), id),
          tonumber(redis.call('ZSCORE', at('expiry'), id) or 0),
          tonumber(redis.call('HGET', at('sizes'), id) or 0)}
end
)";

/// ID FILE LISTED EXPIRE_MS MOST_BYTES MOST_SCENES -> {created, listed, expires, bytes}
inline constexpr const char* kPut = R"(
local id, file, listed = ARGV[1], ARGV[2], ARGV[3]
local life, bytes, scenes = tonumber(ARGV[4]), tonumber(ARGV[5]), tonumber(ARGV[6])
local known = redis.call('GET', at('scene:' .. id))
local created = known and 0 or 1
-- Where another file is there, it was changed inside Redis: what was sent replaces it.
if known ~= file then
  -- Before any other change: a full Redis refuses what takes room in a script's first change only.
  redis.call('SET', at('scene:' .. id), file)
  local stale = redis.call('HGET', at('sizes'), id) or 0
  redis.call('INCRBY', at('total'), #file - stale)
  redis.call('HSET', at('sizes'), id, #file)
  if created == 1 then
    redis.call('ZREM', at('expiry'), id)
    redis.call('SREM', at('listed'), id)
  end
end
expire()
if life > 0 then
  redis.call('PEXPIREAT', at('scene:' .. id), string.format('%.0f', now + life))
  redis.call('ZADD', at('expiry'), now + life, id)
else
  redis.call('PERSIST', at('scene:' .. id))
  redis.call('ZREM', at('expiry'), id)
end
redis.call('ZADD', at('used'), moment, id)
if listed == '1' then redis.call('SADD', at('listed'), id) end
while tonumber(redis.call('GET', at('total'))) > bytes or redis.call('ZCARD', at('used')) > scenes do
  local oldest = redis.call('ZRANGE', at('used'), 0, 1)
  local victim = oldest[1] ~= id and oldest[1] or oldest[2]
  if not victim then break end
  drop(victim)
end
local e = entry(id)
return {created, e[1], e[2], e[3]}
)";

/// ID PAUSE_US -> {listed, expires, bytes}, or nil. Records the use at most once a pause, since
/// Redis writes every change to its disk; not at all if Redis is full.
inline constexpr const char* kTouch = R"(
local id = ARGV[1]
if redis.call('EXISTS', at('scene:' .. id)) == 0 then return false end
local used = tonumber(redis.call('ZSCORE', at('used'), id) or 0)
if moment - used > tonumber(ARGV[2]) then redis.pcall('ZADD', at('used'), moment, id) end
return entry(id)
)";

/// ID -> 1, or 0 where there was none
inline constexpr const char* kRemove = "return drop(ARGV[1])";

/// ID FILE SECONDS -> 1 where the scene's file was FILE and is now in :aside:ID for SECONDS; else
/// 0: it was replaced meanwhile
inline constexpr const char* kSetAside = R"(
local id = ARGV[1]
if redis.call('GET', at('scene:' .. id)) ~= ARGV[2] then return 0 end
redis.call('RENAME', at('scene:' .. id), at('aside:' .. id))
redis.call('EXPIRE', at('aside:' .. id), ARGV[3])
drop(id)
return 1
)";

/// -> {{id, listed, expires, bytes}, ...}
inline constexpr const char* kList = R"(
local all = {}
for _, id in ipairs(redis.call('SMEMBERS', at('listed'))) do
  if redis.call('EXISTS', at('scene:' .. id)) == 1 then
    local e = entry(id)
    all[#all + 1] = {id, e[1], e[2], e[3]}
  end
end
return all
)";

/// -> how many are gone; at most a thousand at once
inline constexpr const char* kExpire = "return expire()";

/// Records (record_store.h): in :record:TABLE/KEY its bytes; in :keys:TABLE the keys of a table; in
/// :recordsizes the bytes and in :recordexpiry the ends (ms), both by TABLE/KEY; :recordtotal is
/// the sum of the sizes; in :try:TABLE/KEY a list of the times of tries (ms).
inline constexpr const char* kRecords = R"(
local function dropRecord(name)
  local had = redis.call('DEL', at('record:' .. name), at('try:' .. name))
  local size = redis.call('HGET', at('recordsizes'), name)
  if size then
    redis.call('DECRBY', at('recordtotal'), size)
    redis.call('HDEL', at('recordsizes'), name)
  end
  redis.call('ZREM', at('recordexpiry'), name)
  local slash = string.find(name, '/', 1, true)
  redis.call('SREM', at('keys:' .. string.sub(name, 1, slash - 1)), string.sub(name, slash + 1))
  return had > 0 and 1 or 0
end
local function keepUntil(name, ends)
  if ends > 0 then
    redis.call('ZADD', at('recordexpiry'), ends, name)
  else
    redis.call('ZREM', at('recordexpiry'), name)
  end
  local slash = string.find(name, '/', 1, true)
  redis.call('SADD', at('keys:' .. string.sub(name, 1, slash - 1)), string.sub(name, slash + 1))
end
)";

/// NAME BYTES ENDS_MS MOST_BYTES -> 1, or 0 where there is no room
inline constexpr const char* kPutRecord = R"(
local name, bytes = ARGV[1], ARGV[2]
local before = tonumber(redis.call('HGET', at('recordsizes'), name) or 0)
local total = tonumber(redis.call('GET', at('recordtotal')) or 0)
if total - before + #bytes > tonumber(ARGV[4]) then return 0 end
redis.call('SET', at('record:' .. name), bytes)
redis.call('INCRBY', at('recordtotal'), #bytes - before)
redis.call('HSET', at('recordsizes'), name, #bytes)
keepUntil(name, tonumber(ARGV[3]))
return 1
)";

/// NAME -> the bytes, or nil
inline constexpr const char* kGetRecord = R"(
local ends = tonumber(redis.call('ZSCORE', at('recordexpiry'), ARGV[1]) or 0)
if ends > 0 and ends <= now then return false end
return redis.call('GET', at('record:' .. ARGV[1]))
)";

/// NAME -> 1, or 0 where there was none
inline constexpr const char* kRemoveRecord = "return dropRecord(ARGV[1])";

/// TABLE -> its keys
inline constexpr const char* kRecordKeys = "return redis.call('SMEMBERS', at('keys:' .. ARGV[1]))";

/// -> how many are gone; at most a thousand at once
inline constexpr const char* kExpireRecords = R"(
local ended = redis.call('ZRANGEBYSCORE', at('recordexpiry'), '-inf', now, 'LIMIT', 0, 1000)
for _, name in ipairs(ended) do dropRecord(name) end
return #ended
)";

/// NAME TOKEN PER_HOUR ALL ENDS_MS -> {granted, left, next in ms or 0}: takeTry() with Redis's
/// clock. A TOKEN that was counted is not counted again: the command may be sent twice.
inline constexpr const char* kTake = R"(
local name, token = ARGV[1], ARGV[2]
local perHour, all = tonumber(ARGV[3]), tonumber(ARGV[4])
local key = at('try:' .. name)
local tries = redis.call('LRANGE', key, 0, -1)
local count = #tries
local function timeOf(entry) return tonumber(string.match(entry, '^%d+')) end
local function upcoming()
  if count < perHour then return now end
  return math.max(now, timeOf(tries[count - perHour + 1]) + 3600000)
end
local granted = 0
if count > 0 and string.match(tries[count], '%s(.*)$') == token then
  granted = 1
elseif count < all and upcoming() <= now then
  local entry = string.format('%.0f %s', now, token)
  redis.call('RPUSH', key, entry)
  keepUntil(name, tonumber(ARGV[5]))
  count = count + 1
  tries[count] = entry
  granted = 1
end
local left = math.max(0, all - count)
return {granted, left, left > 0 and upcoming() or 0}
)";

inline constexpr const char* kBytes = "return tonumber(redis.call('GET', at('total')) or 0)";

}  // namespace farol::server::store::redis
