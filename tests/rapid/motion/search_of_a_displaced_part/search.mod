! RAPID Instructions, Search_1D: the result is the difference between the point that the
! search finds and the search point, as far as the direction of the search goes.
MODULE search
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS wobjdata wPart:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PERS wobjdata wOther:=[FALSE,TRUE,"",[[800,0,700],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  VAR robtarget p;
  VAR robtarget stopped;
  VAR pose inX;
  VAR pose inXY;
  VAR pose found;
  VAR clock watch;

  PROC main()
    MoveAbsJ home,v500,fine,tool0;
    p:=CRobT(\Tool:=tool0\WObj:=wPart);
    ! One direction: what lies across it is not found.
    Search_1D found\SearchStop:=stopped,Offs(p,0,0,30),p,v100,tool0\WObj:=wPart;
    TPWrite ValToStr(found);                                ! -> [[0,0,-1.5],[1,0,0,0]]
    TPWrite ValToStr(Round(stopped.trans.z-p.trans.z\Dec:=3)); ! -> -1.5
    TPWrite ValToStr(Round(Distance(CPos(\Tool:=tool0\WObj:=wPart),p.trans))); ! -> 30
    ! One after the other, each from where the one before has found the part.
    Search_1D inX,Offs(p,-20,0,0),p,v100,tool0\WObj:=wPart;
    Search_1D inXY,Offs(p,0,20,0),p,v100,tool0\WObj:=wPart\PrePDisp:=inX;
    Search_1D found,Offs(p,0,0,30),p,v100,tool0\WObj:=wPart\PrePDisp:=inXY;
    TPWrite ValToStr(found);                                ! -> [[3,2,-1.5],[1,0,0,0]]
    ! The displacement brings the tool to where the part is.
    PDispSet found;
    MoveL p,v100,fine,tool0\WObj:=wPart;
    PDispOff;
    TPWrite ValToStr(Round(Distance(CPos(\Tool:=tool0\WObj:=wPart),p.trans)\Dec:=3)); ! -> 3.905
    ! With a displacement in force, that counts for both points, and the rest is found.
    PDispSet inX;
    Search_1D found,Offs(p,-20,0,0),p,v100,tool0\WObj:=wPart;
    PDispOff;
    TPWrite ValToStr(Abs(found.trans.x)<0.001);             ! -> TRUE
    ! The surface leans about the origin of the work object, and is met where the search crosses it.
    p.trans:=[20,0,0];
    Search_1D found,Offs(p,0,0,30),p,v100,tool0\WObj:=wOther\SearchName:="leaning";
    TPWrite ValToStr(Round(found.trans.z\Dec:=3));          ! -> -3.527
    ! The search itself is made at 20 mm/s, whatever the speed of the moves is.
    ClkStart watch;
    Search_1D found,Offs(p,0,0,30),p,v100,tool0\WObj:=wOther\SearchName:="leaning";
    ClkStop watch;
    TPWrite ValToStr(ClkRead(watch)>1.6);                   ! -> TRUE
    Search_1D found,Offs(p,0,0,30),p,v100,tool0\WObj:=wOther\SearchName:="far"; 
    ! stops: Search_1D finds nothing within 60.0 mm, twice the distance between its points; the controller asks the operator. The part of the station is 70.0 mm away
  ENDPROC
ENDMODULE
