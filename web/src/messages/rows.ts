/** Rows of the catalogue: English, German, Italian. Another language is one more column. */
export type Rows = Record<string, readonly [string, string, string]>;
