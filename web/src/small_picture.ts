/** What a canvas shows, cut to a size in pixels and darkly backed: a JPEG, base64; empty where the browser makes none. */
export function smallPicture(canvas: HTMLCanvasElement, width: number, height: number): string {
  const { width: w, height: h } = canvas;
  const scale = Math.max(width / w, height / h);
  const small = document.createElement('canvas');
  small.width = width;
  small.height = height;
  const pen = small.getContext('2d') as CanvasRenderingContext2D;
  pen.fillStyle = '#20292b';
  pen.fillRect(0, 0, width, height);
  pen.drawImage(canvas, (width - w * scale) / 2, (height - h * scale) / 2, w * scale, h * scale);
  return small.toDataURL('image/jpeg', 0.85).split(',')[1] ?? '';
}
