// Numbers for people.

const MINUS = "\u2212";

/** "1.234e-5" with a proper minus and power of ten; "–" for what is not known. */
export function written(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  if (value === 0) return "0";
  const size = Math.abs(value);
  let text =
    size >= 1e6 || size < 1e-4 ? size.toExponential(digits - 1) : Number(size.toPrecision(digits)).toString();
  const e = text.indexOf("e");
  if (e > 0) {
    const mantissa = Number(text.slice(0, e)).toString();
    text = `${mantissa}\u00b710${superscript(Number(text.slice(e + 1)))}`;
  }
  return (value < 0 ? MINUS : "") + text;
}

function superscript(n: number): string {
  const digits = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079";
  const size = [...Math.abs(n).toString()].map((d) => digits[Number(d)] ?? "").join("");
  return (n < 0 ? "\u207b" : "") + size;
}

/** With the decimals that a step between neighbouring values leaves. */
export function atStep(value: number, step: number): string {
  const decimals = Math.max(0, Math.min(12, -Math.floor(Math.log10(Math.abs(step) || 1) + 1e-9)));
  if (decimals > 6) return written(Number(value.toFixed(decimals)));
  const text = Math.abs(value).toFixed(decimals);
  return (value < 0 && Number(text) !== 0 ? MINUS : "") + text;
}

export function prettyUnit(unit: string): string {
  return unit
    .replace(/\bus\b/g, "\u00b5s")
    .replace(/\bm([23])\b/g, (_, n: string) => "m" + (n === "2" ? "\u00b2" : "\u00b3"))
    .replace(/^1$/, "");
}

export function withUnit(text: string, unit: string): string {
  const pretty = prettyUnit(unit);
  return pretty === "" ? text : `${text}\u00a0${pretty}`;
}

/** Round numbers that divide an interval into about `count` parts. */
export function ticks(from: number, to: number, count: number): { values: number[]; step: number } {
  const raw = (to - from) / Math.max(1, count);
  if (!(raw > 0)) return { values: [from], step: 1 };
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * ([1, 2, 5, 10].find((m) => m * power >= raw * 0.999) ?? 10);
  const values: number[] = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; ++k) values.push(k * step);
  return { values, step };
}

export function clamp(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}
