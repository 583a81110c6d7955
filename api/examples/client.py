#!/usr/bin/env python3
"""Keeps a scene with its files, orbits about it, and deletes it; the standard library alone.

    client.py http://127.0.0.1:8080 scene.zip pictures/
"""
import json
import pathlib
import sys
import urllib.error
import urllib.request


def ask(method, url, body=None, media_type=None):
    """The answer's headers and body; exits with the service's own words where it refuses."""
    headers = {"Content-Type": media_type} if media_type else {}
    request = urllib.request.Request(url, data=body, method=method, headers=headers)
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.headers, answer.read()
    except urllib.error.HTTPError as refusal:
        problem = json.loads(refusal.read())
        for one in problem["errors"]:
            place = f"{one['file']}:{one['line']}: " if "line" in one else ""
            print(f"{place}{one['severity']}: {one['message']} [{one['code']}]", file=sys.stderr)
        sys.exit(1)


def main():
    base, bundle, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    headers, body = ask("POST", base + "/v1/scenes", bundle.read_bytes(), "application/zip")
    scene = json.loads(body)
    print(f"{scene['title']}: {scene['counts']['triangles']} triangles, until {scene['expires']}")
    for azimuth in range(0, 360, 90):
        _, picture = ask("GET", f"{base}{scene['links']['image']}?width=200&height=150&azimuth={azimuth}")
        (folder / f"{azimuth:03}.png").write_bytes(picture)
    ask("DELETE", base + headers["Location"])


if __name__ == "__main__":
    main()
