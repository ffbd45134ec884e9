//! Rows that stay what they are while their list changes, so that focus and a hand on them stay too.

/** A row and how it takes in what is new. */
export interface Row<T> {
  readonly element: HTMLElement;
  update(value: T): void;
}

export class Rows<T> {
  private readonly rows = new Map<string, Row<T>>();

  constructor(
    private readonly place: HTMLElement,
    private readonly make: (value: T) => Row<T>,
    private readonly keyOf: (value: T) => string,
  ) {}

  show(values: readonly T[]): void {
    const keys = new Set(values.map((value) => this.keyOf(value)));
    for (const [key, row] of this.rows) {
      if (keys.has(key)) continue;
      row.element.remove();
      this.rows.delete(key);
    }
    for (const [k, value] of values.entries()) this.showOne(k, value);
  }

  private showOne(k: number, value: T): void {
    const key = this.keyOf(value);
    let row = this.rows.get(key);
    if (row === undefined) {
      row = this.make(value);
      this.rows.set(key, row);
    }
    row.update(value);
    // Moved only where it has to: what is moved loses the focus.
    const there = this.place.children[k];
    if (there !== row.element) this.place.insertBefore(row.element, there ?? null);
  }
}
