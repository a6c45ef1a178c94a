import { svg, type TemplateResult } from 'lit';
import { html } from 'lit';

const PATHS = {
  orbit: 'M12 3a9 9 0 1 0 9 9M21 5v5h-5M8.5 12a3.500 3.500 0 1 0 7 0 3.500 3.500 0 0 0-7 0',
  lasso:
    'M12 4c5 0 9 2.200 9 5.500S17 15 12 15s-9-2.200-9-5.500S7 4 12 4ZM7 14.500c-1.500 1.800-1 4 1.500 4.500 2 .4 2.500 2 1.500 3',
  rectangle:
    'M4 6.500h2M9 6.500h2M13 6.500h2M18 6.500h2v2M20 11v2M20 15.500v2h-2M15 17.500h-2M11 17.500H9M6 17.500H4v-2M4 13v-2',
  part: 'm12 3 8 4.500v9L12 21l-8-4.500v-9L12 3ZM12 12l8-4.500M12 12v9M12 12 4 7.500',
  measure: 'm3 17 14-14 4 4L7 21l-4-4ZM7 13l2 2M10 10l2.500 2.500M13 7l2 2',
  angle: 'M5 19 18 5M5 19h15M11.500 12.200a8 8 0 0 1 3 6.800',
  brush: 'M14 4l6 6-8 8H7v-5l7-9ZM4 20h6',
  loop: 'M12 5.500a6.500 6.500 0 1 0 0 13 6.500 6.500 0 1 0 0-13M12 9.500a2.500 2.500 0 1 0 0 5 2.500 2.500 0 1 0 0-5',
  again: 'M19 12a7 7 0 1 1-2.200-5.100M19 4v4h-4',
  undo: 'M8 5 4 9l4 4M4 9h10a6 6 0 0 1 0 12h-3',
  redo: 'm16 5 4 4-4 4M20 9H10a6 6 0 0 0 0 12h3',
  trash: 'M5 7h14M10 7V4.500h4V7M7 7l1 13h8l1-13M10.500 11v5.500M13.500 11v5.500',
  theme: 'M12 4a8 8 0 1 0 0 16V4Z M12 4a8 8 0 0 1 0 16',
  keys: 'M3.500 7h17v10h-17zM7 10.500h.01M10.500 10.500h.01M14 10.500h.01M17 10.500h.01M8 14h8',
  link: 'M10 14a4 4 0 0 0 6 .4l3-3a4 4 0 0 0-5.700-5.700L12 7M14 10a4 4 0 0 0-6-.4l-3 3a4 4 0 0 0 5.700 5.700L12 17',
  parallel: 'M4 9h10v10H4zM10 5h10v10M4 9l6-4M14 9l6-4M14 19l6-4',
  like: 'M5 5h5v5H5zM14 5h5v5h-5zM5 14h5v5H5zM14 16.500h5M16.500 14v5',
  fit: 'M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5M9 12a3 3 0 1 0 6 0 3 3 0 0 0-6 0',
  play: 'M8 5v14l11-7L8 5Z',
  pause: 'M8.500 5v14M15.500 5v14',
  check: 'm5 12.500 4.500 4.500L19 7.500',
  copy: 'M9 9h10v11H9zM5 15V4h10',
  download: 'M12 4v11M7.500 11 12 15.500 16.500 11M5 20h14',
  arrow: 'M5 12h14M13 6l6 6-6 6',
  close: 'M6 6l12 12M18 6 6 18',
  sun: 'M12 8a4 4 0 1 0 0 8 4 4 0 1 0 0-8M12 3v2M12 19v2M3 12h2M19 12h2M5.600 5.600 7 7M17 17l1.400 1.400M18.400 5.600 17 7M7 17l-1.400 1.400',
  layers: 'm12 4 9 4.500-9 4.500-9-4.500L12 4ZM4.500 12 12 15.800l7.500-3.800M4.500 15.500 12 19.300l7.500-3.800',
  folder: 'M3.500 6h6l2 2.500h9V19h-17z',
  flip: 'M12 4v16M9 8 4 16h5V8ZM15 8l5 8h-5V8Z',
} as const;
export type IconName = keyof typeof PATHS;

export const icon = (name: IconName): TemplateResult =>
  html`<svg class="icon" viewBox="0 0 24 24" aria-hidden="true">${svg`<path d=${PATHS[name]} />`}</svg>`;

export const logo = html`<svg class="logo" viewBox="0 0 32 32" aria-hidden="true">
  <path d="M6 12v8" stroke-width="1.2" />
  <path d="M10.500 8v4c2.200 1.500 2.200 6.500 0 8v4" stroke-width="1.800" />
  <path d="M15.500 5.500V11c3.600 2.200 3.600 7.800 0 10v5.500" stroke-width="2.400" />
  <path d="M20.500 8v4c3 1.500 3 6.500 0 8v4" stroke-width="1.800" />
  <path d="M25.500 12v8" stroke-width="1.200" />
</svg>`;
