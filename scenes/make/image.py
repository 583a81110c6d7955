"""Pictures as flat lists of (r, g, b), or (r, g, b, alpha) of a PNG, with 0..255 floats, row 0 on
top, and two writers: PNG for what must be exact, baseline JPEG (4:4:4, Huffman tables fitted to the
picture) for what is noisy. Both give the same bytes on every run."""

import math
import struct
import zlib


class Image:
    quality = 88  # as JPEG, 0..100

    def __init__(self, width, height, color=(0, 0, 0)):
        self.width, self.height = width, height
        self.pixels = [color] * (width * height)

    @classmethod
    def of(cls, width, height, shade):
        """The picture whose pixel (x, y) is shade(u, v) at its middle; v runs upwards."""
        image = cls(width, height)
        image.pixels = [
            shade((x + 0.5) / width, 1.0 - (y + 0.5) / height)
            for y in range(height)
            for x in range(width)
        ]
        return image

    def put(self, x, y, color):
        if 0 <= x < self.width and 0 <= y < self.height:
            self.pixels[y * self.width + x] = color

    def get(self, x, y):
        return self.pixels[(y % self.height) * self.width + x % self.width]

    def rectangle(self, x0, y0, x1, y1, color):
        for y in range(max(0, y0), min(self.height, y1)):
            for x in range(max(0, x0), min(self.width, x1)):
                self.pixels[y * self.width + x] = color

    def paste(self, other, x0, y0):
        for y in range(other.height):
            start = (y0 + y) * self.width + x0
            self.pixels[start : start + other.width] = other.pixels[
                y * other.width : (y + 1) * other.width
            ]

    def bytes(self):
        return bytes(
            0 if c <= 0 else 255 if c >= 255 else int(c + 0.5) for p in self.pixels for c in p
        )


def write(path, image):
    data = png(image) if str(path).endswith(".png") else jpeg(image)
    with open(path, "wb") as out:
        out.write(data)


def png(image):
    def chunk(kind, data):
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    raw, samples = image.bytes(), len(image.pixels[0])
    colors = {raw[i : i + 3] for i in range(0, len(raw), 3)}
    head = b"\x89PNG\r\n\x1a\n"
    if len(colors) <= 256 and samples == 3:
        palette = sorted(colors)
        index = {color: i for i, color in enumerate(palette)}
        body = bytes(index[raw[i : i + 3]] for i in range(0, len(raw), 3))
        stride, kind, extra = image.width, 3, chunk(b"PLTE", b"".join(palette))
    else:
        body, stride, kind, extra = raw, image.width * samples, 2 if samples == 3 else 6, b""
    lines = []
    for y in range(image.height):
        line = body[y * stride : (y + 1) * stride]
        if kind == 3:
            lines.append(b"\0" + line)
        else:  # filter Sub
            lines.append(
                b"\1"
                + line[:samples]
                + bytes((a - b) & 255 for a, b in zip(line[samples:], line[:-samples]))
            )
    header = struct.pack(">IIBBBBB", image.width, image.height, 8, kind, 0, 0, 0)
    return (
        head
        + chunk(b"IHDR", header)
        + extra
        + chunk(b"IDAT", zlib.compress(b"".join(lines), 9))
        + chunk(b"IEND", b"")
    )


# JPEG, after ITU-T T.81: level shift, 8x8 DCT, quantisation, zigzag, Huffman.

_BASIS = [
    [
        (math.sqrt(0.125) if k == 0 else 0.5) * math.cos((2 * n + 1) * k * math.pi / 16)
        for n in range(8)
    ]
    for k in range(8)
]
_ZIGZAG = sorted(
    range(64),
    key=lambda i: (i // 8 + i % 8, i // 8 if (i // 8 + i % 8) % 2 else i % 8),
)


def _quantisers(quality):
    """Coarser towards high frequencies, for brightness and for colour."""
    scale = 0.16 + (100 - quality) / 40.0

    def table(base, slope):
        return [
            max(1, min(255, int(scale * (base + slope * (i // 8 + i % 8) ** 1.3) + 0.5)))
            for i in range(64)
        ]

    return table(10, 3.0), table(14, 6.0)


def _transform(block):
    """The 8x8 DCT of 64 numbers: even and odd half sums, so half the products."""
    rows = []
    for y in range(0, 64, 8):
        a, b, c, d, e, f, g, h = block[y : y + 8]
        s0, s1, s2, s3 = a + h, b + g, c + f, d + e
        t0, t1, t2, t3 = a - h, b - g, c - f, d - e
        rows.append([
            m[0] * s0 + m[1] * s1 + m[2] * s2 + m[3] * s3
            if not k & 1
            else m[0] * t0 + m[1] * t1 + m[2] * t2 + m[3] * t3
            for k, m in enumerate(_BASIS)
        ])
    out = [0.0] * 64
    for x in range(8):
        a, b, c, d, e, f, g, h = (row[x] for row in rows)
        s0, s1, s2, s3 = a + h, b + g, c + f, d + e
        t0, t1, t2, t3 = a - h, b - g, c - f, d - e
        for k, m in enumerate(_BASIS):
            out[k * 8 + x] = (
                m[0] * s0 + m[1] * s1 + m[2] * s2 + m[3] * s3
                if not k & 1
                else m[0] * t0 + m[1] * t1 + m[2] * t2 + m[3] * t3
            )
    return out


def _code_lengths(counts):
    """Huffman lengths of at most 16 bits (T.81, annex K.2); the all-ones code stays free."""
    groups = [(count, [symbol]) for symbol, count in sorted(counts.items())]
    groups.append((0, [256]))  # takes the longest code, the one of all ones
    length = {symbol: 0 for _, symbols in groups for symbol in symbols}
    while len(groups) > 1:
        groups.sort(key=lambda group: (group[0], -group[1][0]))
        (c0, s0), (c1, s1) = groups[0], groups[1]
        for symbol in s0 + s1:
            length[symbol] += 1
        groups = groups[2:] + [(c0 + c1, s0 + s1)]
    bits = [0] * 64
    for value in length.values():
        bits[value] += 1
    for i in range(63, 16, -1):
        while bits[i] > 0:
            j = i - 2
            while bits[j] == 0:
                j -= 1
            bits[i] -= 2
            bits[i - 1] += 1
            bits[j + 1] += 2
            bits[j] -= 1
    last = max(i for i in range(17) if bits[i])
    bits[last] -= 1
    ordered = sorted((s for s in length if s != 256), key=lambda s: (length[s], s))
    return bits[1:17], ordered


def _codes(bits, ordered):
    codes, code, at = {}, 0, 0
    for length, count in enumerate(bits, start=1):
        for symbol in ordered[at : at + count]:
            codes[symbol] = (code, length)
            code += 1
        at += count
        code <<= 1
    return codes


def _size(value):
    return abs(value).bit_length()


def _symbols(values, before):
    """One block's (table, symbol, extra bits, their number); table 0 is DC, 1 is AC."""
    step = values[0] - before
    size = _size(step)
    out = [(0, size, step if step >= 0 else step + (1 << size) - 1, size)]
    run = 0
    for value in values[1:]:
        if value == 0:
            run += 1
            continue
        while run > 15:
            out.append((1, 0xF0, 0, 0))
            run -= 16
        size = _size(value)
        out.append((1, run << 4 | size, value if value > 0 else value + (1 << size) - 1, size))
        run = 0
    if run:
        out.append((1, 0, 0, 0))
    return out


def jpeg(image):
    width, height = image.width, image.height
    across, down = (width + 7) // 8, (height + 7) // 8
    quantisers = _quantisers(image.quality)
    raw = image.bytes()
    planes = [[], [], []]
    for i in range(0, len(raw), 3):
        r, g, b = raw[i], raw[i + 1], raw[i + 2]
        planes[0].append(0.299 * r + 0.587 * g + 0.114 * b - 128.0)
        planes[1].append(-0.168736 * r - 0.331264 * g + 0.5 * b)
        planes[2].append(0.5 * r - 0.418688 * g - 0.081312 * b)
    stream, before = [], [0, 0, 0]
    for by in range(down):
        for bx in range(across):
            for c in range(3):
                block = []
                for y in range(by * 8, by * 8 + 8):
                    start = min(y, height - 1) * width
                    row = planes[c][start + bx * 8 : start + min(width, bx * 8 + 8)]
                    block += row + [row[-1]] * (8 - len(row))
                table = quantisers[c > 0]
                freq = _transform(block)
                values = [round(freq[i] / table[i]) for i in _ZIGZAG]
                stream.append((c > 0, _symbols(values, before[c])))
                before[c] = values[0]
    counts = {(c, t): {} for c in (0, 1) for t in (0, 1)}
    for c, symbols in stream:
        for table, symbol, _, _ in symbols:
            count = counts[int(c), table]
            count[symbol] = count.get(symbol, 0) + 1
    codes, tables = {}, b""
    for (c, t), count in counts.items():
        bits, ordered = _code_lengths(count)
        codes[c, t] = _codes(bits, ordered)
        tables += bytes([t << 4 | c]) + bytes(bits) + bytes(ordered)

    def segment(marker, data):
        return struct.pack(">BBH", 0xFF, marker, len(data) + 2) + data

    out = [b"\xff\xd8", segment(0xE0, b"JFIF\0\1\1\0\0\1\0\1\0\0")]
    for i in (0, 1):
        out.append(segment(0xDB, bytes([i]) + bytes(quantisers[i][j] for j in _ZIGZAG)))
    frame = struct.pack(">BHHB", 8, height, width, 3) + bytes([1, 17, 0, 2, 17, 1, 3, 17, 1])
    out.append(segment(0xC0, frame))
    out.append(segment(0xC4, tables))
    out.append(segment(0xDA, bytes([3, 1, 0x00, 2, 0x11, 3, 0x11, 0, 63, 0])))
    body, buffer, used = bytearray(), 0, 0
    for c, symbols in stream:
        for table, symbol, extra, size in symbols:
            code, length = codes[int(c), table][symbol]
            buffer = (buffer << length | code) << size | extra
            used += length + size
            while used >= 8:
                used -= 8
                byte = buffer >> used & 255
                body.append(byte)
                if byte == 255:
                    body.append(0)
            buffer &= (1 << used) - 1
    if used:
        byte = (buffer << 8 - used | (1 << 8 - used) - 1) & 255
        body.append(byte)
        if byte == 255:
            body.append(0)
    out += [bytes(body), b"\xff\xd9"]
    return b"".join(out)
