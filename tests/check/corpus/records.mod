MODULE records
  RECORD part
    string name;
    num mass;
    robtarget grip;
    bool fragile;
  ENDRECORD
  LOCAL RECORD stack
    num count;
    part top;
  ENDRECORD
  ALIAS num millimetre;
  CONST millimetre gap:=3;
  PERS part parts{2}:=[["Housing",2.4,[[300,0,400],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],FALSE],["Lid",0.3,[[300,50,400],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],TRUE]];
  LOCAL VAR stack pile;
  PROC main()
    VAR num sum:=0;
    FOR k FROM Dim(parts,1) TO 1 STEP -1 DO
      sum:=sum+parts{k}.mass;
      pile.top:=parts{k};
      pile.count:=pile.count+1;
      IF parts{k}.fragile AND parts{k}.grip.trans.z>gap MoveJ parts{k}.grip,v200,z10,tool0;
    ENDFOR
    parts{1}.grip.trans.x:=parts{1}.grip.trans.x+gap;
    TPWrite pile.top.name\Num:=sum;
  ENDPROC
ENDMODULE
