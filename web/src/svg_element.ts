/** An element of SVG with its attributes. */
export const svgElement = (name: string, attributes: Record<string, string>): SVGElement => {
  const one = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, value);
  return one;
};
