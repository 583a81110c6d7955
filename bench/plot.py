"""Plots as SVG by the standard library alone: points, lines, stacked bars; linear and log axes."""

import math
from html import escape

COLORS = ["#1f6fb4", "#d1495b", "#2a9d5c", "#e08e1b", "#7a4fb0", "#4f4f4f", "#14a3a8", "#a3622a",
          "#c23fa0", "#6b8e23", "#3a3f8f", "#b8860b"]
LEFT, TOP, BOTTOM = 70, 46, 52


def number(value):
    if value == 0:
        return "0"
    if abs(value) >= 1000:
        return f"{value:,.0f}".replace(",", "\u202f")
    return f"{value:.3g}"


class Axis:
    """Data to 0..1, and the ticks."""

    def __init__(self, values, log, from_zero=False):
        values = [v for v in values if v is not None and (not log or v > 0)]
        self.log = log
        low, high = (min(values), max(values)) if values else (1, 10)
        if log:
            self.low, self.high = math.log10(low) - 0.06, math.log10(high) + 0.06
        else:
            low = 0 if from_zero else low
            room = 0.05 * ((high - low) or abs(high) or 1)
            self.low, self.high = (0 if from_zero else low - room), high + room
        if self.high - self.low < 1e-9:
            self.low, self.high = self.low - 0.5, self.high + 0.5

    def place(self, value):
        if self.log:
            value = math.log10(value) if value > 0 else self.low
        return (value - self.low) / (self.high - self.low)

    def ticks(self):
        if self.log:
            decades = self.high - self.low
            steps = (1, 2, 5) if decades < 3 else (1,)
            every = max(1, math.ceil(decades / 8))
            return [s * 10.0**e for e in range(math.floor(self.low), math.ceil(self.high) + 1)
                    if e % every == 0 for s in steps
                    if self.low <= math.log10(s * 10.0**e) <= self.high]
        span = self.high - self.low
        step = 10 ** math.floor(math.log10(span / 4))
        step *= next(m for m in (1, 2, 5, 10) if span / (step * m) <= 7)
        first = math.ceil(self.low / step)
        return [i * step for i in range(first, math.floor(self.high / step) + 1)]


class Plot:
    """Series are (name, [(x, y)], {"line": bool, "marker": bool, "dash": bool, "labels": [...]})."""

    def __init__(self, title, x, y, logx=False, logy=False, width=760, height=440, note=""):
        self.title, self.x, self.y, self.note = title, x, y, note
        self.logx, self.logy = logx, logy
        self.width, self.height = width, height
        self.series = []

    def add(self, name, points, **style):
        points = [(a, b) for a, b in points if a is not None and b is not None
                  and (a > 0 or not self.logx) and (b > 0 or not self.logy)]
        if points:
            self.series.append((name, points, style))

    def svg(self):
        legend = 200
        right = self.width - legend
        bottom = self.height - BOTTOM
        ax = Axis([p[0] for s in self.series for p in s[1]], self.logx)
        ay = Axis([p[1] for s in self.series for p in s[1]], self.logy, from_zero=not self.logy)
        out = head(self.width, self.height, self.title, self.note)

        def sx(v):
            return LEFT + ax.place(v) * (right - LEFT)

        def sy(v):
            return bottom - ay.place(v) * (bottom - TOP)

        for tick in ax.ticks():
            out.append(f'<path class="grid" d="M{sx(tick):.1f} {TOP}V{bottom}"/>'
                       f'<text x="{sx(tick):.1f}" y="{bottom + 16}" class="mid">{number(tick)}</text>')
        for tick in ay.ticks():
            out.append(f'<path class="grid" d="M{LEFT} {sy(tick):.1f}H{right}"/>'
                       f'<text x="{LEFT - 6}" y="{sy(tick) + 4:.1f}" class="end">{number(tick)}</text>')
        out.append(f'<path class="axis" d="M{LEFT} {TOP}V{bottom}H{right}"/>')
        out.append(f'<text x="{(LEFT + right) / 2}" y="{bottom + 36}" class="mid">{escape(self.x)}</text>')
        out.append(f'<text transform="translate(16 {(TOP + bottom) / 2}) rotate(-90)" class="mid">'
                   f'{escape(self.y)}</text>')
        for i, (name, points, style) in enumerate(self.series):
            color = COLORS[i % len(COLORS)]
            if style.get("line", True):
                path = " ".join(f"{sx(a):.1f},{sy(b):.1f}" for a, b in points)
                dash = ' stroke-dasharray="5 4"' if style.get("dash") else ""
                out.append(f'<polyline points="{path}" fill="none" stroke="{color}" '
                           f'stroke-width="1.8"{dash}/>')
            if style.get("marker", True):
                for a, b in points:
                    out.append(f'<circle cx="{sx(a):.1f}" cy="{sy(b):.1f}" r="3.2" fill="{color}"/>')
            for (a, b), label in zip(points, style.get("labels", [])):
                side = 5 if sx(a) < right - 90 else -5
                anchor = "start" if side > 0 else "end"
                out.append(f'<text x="{sx(a) + side:.1f}" y="{sy(b) - 5:.1f}" class="small" '
                           f'text-anchor="{anchor}">'
                           f'{escape(label)}</text>')
            y = TOP + 10 + 18 * i
            out.append(f'<rect x="{right + 14}" y="{y - 9}" width="12" height="10" fill="{color}"/>'
                       f'<text x="{right + 31}" y="{y}">{escape(name)}</text>')
        return "\n".join(out + ["</svg>", ""])


class Bars:
    """Horizontal bars, stacked: rows are (name, {part: value})."""

    def __init__(self, title, x, rows, width=760, note=""):
        self.title, self.x, self.rows, self.width, self.note = title, x, rows, width, note

    def svg(self):
        parts = list(dict.fromkeys(p for _, values in self.rows for p in values))
        height = TOP + 24 + 22 * len(self.rows) + BOTTOM
        left, right, top = 190, self.width - 70, TOP + 24
        axis = Axis([sum(v.values()) for _, v in self.rows], False, from_zero=True)
        bottom = height - BOTTOM
        out = head(self.width, height, self.title, self.note)
        for tick in axis.ticks():
            x = left + axis.place(tick) * (right - left)
            out.append(f'<path class="grid" d="M{x:.1f} {top}V{bottom}"/>'
                       f'<text x="{x:.1f}" y="{bottom + 16}" class="mid">{number(tick)}</text>')
        out.append(f'<text x="{(left + right) / 2}" y="{bottom + 36}" class="mid">{escape(self.x)}</text>')
        for i, part in enumerate(parts):
            if len(parts) > 1:
                x = left + i * 105
                out.append(f'<rect x="{x}" y="{TOP - 2}" width="12" height="10" fill="{COLORS[i]}"/>'
                           f'<text x="{x + 16}" y="{TOP + 7}">{escape(part)}</text>')
        for row, (name, values) in enumerate(self.rows):
            y, x = top + 22 * row + 3, left
            out.append(f'<text x="{left - 8}" y="{y + 12}" class="end">{escape(name)}</text>')
            for part, value in values.items():
                width = axis.place(value) * (right - left)
                out.append(f'<rect x="{x:.1f}" y="{y}" width="{max(0.0, width):.1f}" height="16" '
                           f'fill="{COLORS[parts.index(part) % len(COLORS)]}"/>')
                x += width
            out.append(f'<text x="{x + 5:.1f}" y="{y + 12}">{number(sum(values.values()))}</text>')
        return "\n".join(out + ["</svg>", ""])


def head(width, height, title, note):
    return [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
            f'width="{width}" height="{height}" role="img" aria-label="{escape(title)}">',
            "<style>text{font:12px sans-serif;fill:#222}.mid{text-anchor:middle}.end{text-anchor:end}"
            ".small{font-size:10px;fill:#555}.grid{stroke:#ddd;fill:none}"
            ".axis{stroke:#444;fill:none}.title{font-size:15px;font-weight:bold}</style>",
            f'<rect width="{width}" height="{height}" fill="#fff"/>',
            f'<text x="12" y="20" class="title">{escape(title)}</text>',
            f'<text x="12" y="36" class="small">{escape(note)}</text>']
