// SPDX-License-Identifier: MIT
// Reads JSON strictly: each unexpected value is an error that names its position.

export class Value {
  constructor(
    private readonly value: unknown,
    readonly path: string,
  ) {}

  fail(expected: string): never {
    throw new Error(`${this.path || "the data"}: expected ${expected}`);
  }

  get isThere(): boolean {
    return this.value !== undefined;
  }

  get isNull(): boolean {
    return this.value === null;
  }

  is(text: string): boolean {
    return this.value === text;
  }

  get isNumber(): boolean {
    return typeof this.value === "number" && Number.isFinite(this.value);
  }

  // Returns the keys of an object.
  names(): string[] {
    const object = this.value;
    if (typeof object !== "object" || object === null || Array.isArray(object))
      this.fail("an object");
    return Object.keys(object as object);
  }

  key(name: string): Value {
    const object = this.value;
    if (typeof object !== "object" || object === null || Array.isArray(object))
      this.fail("an object");
    const own = Object.prototype.hasOwnProperty.call(object, name);
    const value = own ? (object as Record<string, unknown>)[name] : undefined;
    return new Value(value, this.path === "" ? name : `${this.path}.${name}`);
  }

  // Fails if the object has a key other than these, because an unknown key may be an expected one under a wrong
  // name.
  only(...names: string[]): void {
    for (const name of Object.keys(this.value as object))
      if (!names.includes(name)) this.fail(`no '${name.slice(0, 40)}', but ${names.join(", ")}`);
  }

  list(length = -1): Value[] {
    if (!Array.isArray(this.value)) this.fail("a list");
    const all = this.value as unknown[];
    if (length >= 0 && all.length !== length) this.fail(`a list of ${length}`);
    return all.map((value, i) => new Value(value, `${this.path}[${i}]`));
  }

  text(): string {
    if (typeof this.value !== "string") this.fail("a text");
    return this.value as string;
  }

  number(): number {
    if (typeof this.value !== "number" || !Number.isFinite(this.value)) this.fail("a number");
    return this.value as number;
  }

  // Returns an integer with least <= value < bound.
  integer(least: number, bound: number): number {
    const value = this.value;
    if (typeof value !== "number" || !Number.isSafeInteger(value) ||
        value < least || value >= bound)
      this.fail(`a whole number from ${least} to ${bound - 1}`);
    return value as number;
  }

  // Returns a list of integers, without creating a Value for each of them. `length`: -1 for any.
  safeIntegers(length = -1): number[] {
    if (!Array.isArray(this.value) || !this.value.every(Number.isSafeInteger))
      this.fail("a list of whole numbers");
    const all = this.value as number[];
    if (length >= 0 && all.length !== length) this.fail(`a list of ${length}`);
    return all;
  }

  // Returns an integer of any size. A value beyond 2^53 is rounded, but no correct value is so large.
  wholeNumber(): number {
    const value = this.value;
    if (typeof value !== "number" || !Number.isInteger(value)) this.fail("a whole number");
    return value as number;
  }

  // Returns the result of `read` for the text. Errors from `read` get the position of this value.
  as<T>(read: (text: string) => T): T {
    try {
      return read(this.text());
    } catch (error) {
      throw new Error(`${this.path}: ${error instanceof Error ? error.message : String(error)}`);
    }
  }
}

export function parse(text: string): Value {
  try {
    return new Value(JSON.parse(text), "");
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    throw new Error(`the data is no JSON: ${why}`);
  }
}
