/** A sheet of paper, mm, and the side of a square that fills it with 11 by 8 squares. */
export const PAPERS = {
  A4: { width: 297, height: 210, square: 23 },
  A3: { width: 420, height: 297, square: 34 },
  Letter: { width: 279.4, height: 215.9, square: 22 },
} as const;
export type Paper = keyof typeof PAPERS;

/** Squares of the board; the corners between them are one fewer each way. */
const SQUARES = { x: 11, y: 8 };
export const CORNERS = { columns: SQUARES.x - 1, rows: SQUARES.y - 1 };

const POINTS_PER_MM = 72 / 25.4;

/** A checkerboard as a PDF of one page. `lines` are printed below it, letters of Latin-1 only. */
export function boardPdf(paper: Paper, lines: readonly string[]): Blob {
  const { width, height, square } = PAPERS[paper];
  const pt = (mm: number): string => (mm * POINTS_PER_MM).toFixed(3);
  const left = (width - SQUARES.x * square) / 2;
  const top = Math.min((height - SQUARES.y * square) / 2, 8);
  const bottom = height - top - SQUARES.y * square;
  const drawing: string[] = ['0 g'];
  for (let y = 0; y < SQUARES.y; y++)
    for (let x = 0; x < SQUARES.x; x++)
      if ((x + y) % 2 === 0)
        drawing.push(
          `${pt(left + x * square)} ${pt(bottom + (SQUARES.y - 1 - y) * square)} ${pt(square)} ${pt(square)} re f`,
        );
  const escaped = (text: string) => text.replace(/[\\()]/g, '\\$&');
  lines.forEach((line, i) =>
    drawing.push(`BT /F 9 Tf ${pt(left)} ${pt(bottom - 5 - 4.2 * i)} Td (${escaped(line)}) Tj ET`),
  );
  const content = drawing.join('\n');
  const objects = [
    '<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>',
    '<< /Type /Pages /Kids [3 0 R] /Count 1 >>',
    `<< /Type /Page /Parent 2 0 R /MediaBox [0 0 ${pt(width)} ${pt(height)}] /Contents 4 0 R /Resources << /Font << /F 5 0 R >> >> >>`,
    `<< /Length ${content.length} >>\nstream\n${content}\nendstream`,
    '<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>',
  ];
  let text = '%PDF-1.4\n';
  const offsets = objects.map((object, i) => {
    const at = text.length;
    text += `${i + 1} 0 obj\n${object}\nendobj\n`;
    return at;
  });
  const table = text.length;
  text += `xref\n0 ${objects.length + 1}\n0000000000 65535 f \n`;
  text += offsets.map((at) => `${String(at).padStart(10, '0')} 00000 n \n`).join('');
  text += `trailer\n<< /Size ${objects.length + 1} /Root 1 0 R >>\nstartxref\n${table}\n%%EOF\n`;
  return new Blob([Uint8Array.from(text, (letter) => letter.charCodeAt(0))], { type: 'application/pdf' });
}
