! RAPID Kernel, Placeholders: what a named thing is made of must be there.
MODULE unfinished
  <TDN>                         ! error: E149
  <DDN>                         ! error: E149
  RECORD part
    num number;
    <TDN>                       ! error: E149
  ENDRECORD
  RECORD empty
    <TDN>                       ! error: E149
  ENDRECORD
  VAR num list{<DIM>};          ! error: E149
  <RDN>                         ! error: E149

  PROC main(<PAR>)              ! error: E149
  ENDPROC

  PROC choose(\num a|<ALT>)     ! error: E149
  ENDPROC
ENDMODULE
