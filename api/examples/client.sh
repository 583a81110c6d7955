#!/bin/sh
# Keeps a scene with its files, orbits about it, and deletes it; curl and a POSIX shell.
#
#     client.sh http://127.0.0.1:8080 scene.zip pictures/
set -eu
base=$1 bundle=$2 folder=$3
mkdir -p "$folder"
address=$(curl --fail-with-body --silent --show-error -H 'Content-Type: application/zip' \
    --data-binary "@$bundle" -o "$folder/scene.json" -w '%header{location}' "$base/v1/scenes")
for azimuth in 000 090 180 270; do
    curl --fail --silent --show-error -o "$folder/$azimuth.png" \
        "$base$address/image?width=200&height=150&azimuth=$azimuth"
done
curl --fail --silent --show-error -X DELETE "$base$address"
