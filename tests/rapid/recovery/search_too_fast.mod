! RAPID Instructions, SearchL: \Stop leaves the path, which is for slow searches only.
MODULE search_too_fast
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS bool touched:=FALSE;
  VAR robtarget found;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    SearchL\PStop,touched,found,Offs(p1,0,10,0),v200,tool0;
    TPWrite "never, nothing is there";
  ERROR
    TPWrite "nothing "\Bool:=ERRNO=ERR_WHLSEARCH;       ! -> nothing TRUE
    fast;
  ENDPROC

  PROC fast()
    SearchL\Stop,touched,found,p2,v200,tool0;           ! stops: SearchL \Stop at 200 mm/s: at most 100 are allowed; \PStop and \SStop stop on the path
  ENDPROC
ENDMODULE
