#!/usr/bin/env python3
"""object_store_test.py CLI: joins a map into an object store, a small server on this machine that
speaks as much of S3 as is needed, and compares the object with a file made by one `prepare`."""

import http.server
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77


class Store(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    objects: dict[str, bytes] = {}
    uploads: dict[str, dict[int, bytes]] = {}

    def log_message(self, *arguments):
        pass

    def answer(self, status, body=b"", headers=()):
        self.send_response(status)
        for name, value in headers:
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)

    def address(self):
        url = urllib.parse.urlsplit(self.path)
        return url.path, dict(urllib.parse.parse_qsl(url.query, keep_blank_values=True))

    def body(self):
        if self.headers.get("Transfer-Encoding") == "chunked":
            parts = []
            while size := int(self.rfile.readline(), 16):
                parts.append(self.rfile.read(size))
                self.rfile.readline()
            self.rfile.readline()
            return b"".join(parts)
        return self.rfile.read(int(self.headers.get("Content-Length", 0)))

    def do_PUT(self):
        path, query = self.address()
        body = self.body()
        if "partNumber" in query:
            self.uploads[query["uploadId"]][int(query["partNumber"])] = body
        else:
            self.objects[path] = body
        self.answer(200, headers=[("ETag", f'"{len(body)}"')])

    def do_POST(self):
        path, query = self.address()
        self.body()
        if "uploads" in query:
            upload = str(len(self.uploads))
            self.uploads[upload] = {}
            xml = f"<InitiateMultipartUploadResult><UploadId>{upload}</UploadId>" \
                  "</InitiateMultipartUploadResult>"
        else:
            parts = self.uploads[query["uploadId"]]
            self.objects[path] = b"".join(parts[number] for number in sorted(parts))
            xml = "<CompleteMultipartUploadResult/>"
        self.answer(200, xml.encode())

    def do_GET(self):
        path, _ = self.address()
        if path not in self.objects:
            self.answer(404)
            return
        content = self.objects[path]
        headers = [("ETag", f'"{len(content)}"'), ("Accept-Ranges", "bytes")]
        asked = re.fullmatch(r"bytes=(\d+)-(\d*)", self.headers.get("Range", ""))
        if not asked:
            self.answer(200, content, headers)
            return
        first = int(asked.group(1))
        last = min(int(asked.group(2) or len(content)), len(content) - 1)
        headers.append(("Content-Range", f"bytes {first}-{last}/{len(content)}"))
        self.answer(206, content[first : last + 1], headers)

    do_HEAD = do_GET


def main():
    cli = sys.argv[1]
    if not shutil.which("gdal_translate"):
        print("SKIPPED: gdal_translate is not installed")
        return SKIPPED
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Store)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    environment = os.environ | {
        "AWS_S3_ENDPOINT": f"127.0.0.1:{server.server_port}",
        "AWS_HTTPS": "NO",
        "AWS_VIRTUAL_HOSTING": "FALSE",
        "AWS_NO_SIGN_REQUEST": "YES",
        "VSIS3_CHUNK_SIZE": "5",
        "no_proxy": "127.0.0.1",
    }
    with tempfile.TemporaryDirectory() as folder:

        def run(*arguments):
            subprocess.run(arguments, check=True, env=environment, cwd=folder,
                           stdout=subprocess.DEVNULL)

        sample = ROOT / "resources/samples/mars_mola_4ppd.tif"
        run("gdal_translate", "-q", "-outsize", "500%", "500%", str(sample), "dem.tif")
        run(cli, "prepare", "dem.tif", "-o", "whole.tif")
        prepare = (cli, "prepare", "dem.tif", "-o", "s3://maps/mars.tif", "--parts-folder", "parts",
                   "--parts", "3")
        for part in ("1", "2", "3"):
            run(*prepare, "--part", part)
        run(*prepare, "--join")
        whole = pathlib.Path(folder, "whole.tif").read_bytes()
        if Store.objects.get("/maps/mars.tif") != whole:
            print(f"the object differs from the file; there are {sorted(Store.objects)}")
            return 1
        pieces = max((len(parts) for parts in Store.uploads.values()), default=1)
        if len(Store.objects["/maps/mars.tif.marsview"]) < 1000:
            print("there is no level file")
            return 1
        run(cli, "info", "s3://maps/mars.tif", "--json")
        print(f"an object of {len(whole)} bytes, written in {pieces} pieces: equal")
    return 0


sys.exit(main())
